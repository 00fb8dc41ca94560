// SPDX-License-Identifier: GPL-3.0-or-later
// Damaged files passed to the command: each crashes or hangs the library that reads it.
#include <filesystem>
#include <fstream>
#include <sstream>
#include <sys/stat.h>

#include <catch2/catch.hpp>

#include "geometry/foundation/temporary_folder.h"
#include "mesher/gmsh/mesh_import.h"
#include "mesher/gmsh/script_mesher.h"
#include "mesher/mesh/mesh_file.h"
#include "tests/support/files.h"
#include "tests/support/flexneck_command.h"

using Catch::Matchers::Contains;
using namespace flexneck;
using testing::bytes_of;
using testing::CommandOutcome;

namespace {

namespace fs = std::filesystem;

void write(const fs::path& path, const std::string& contents) {
  std::ofstream(path, std::ios::binary) << contents;
}

CommandOutcome run_flexneck(const fs::path& folder, const std::string& arguments) {
  return testing::run_shell("cd " + folder.string() + " && TMPDIR=" + folder.string() + " " +
                            testing::flexneck_program() + " -q " + arguments);
}

/// Checks for exit code 2, one line, and no remainders in the folder for temporary files.
void check_refused(const fs::path& folder, const std::string& arguments,
                   const std::string& reason) {
  INFO(arguments);
  testing::check_refused(run_flexneck(folder, arguments), reason);
  for (const auto& entry : fs::directory_iterator(folder))
    CHECK_FALSE(entry.path().filename().string().starts_with("flexneck-"));
}

/// Writes a study of a file, or of a script, with the part `part`.
void write_study(const fs::path& path, const std::string& source, const std::string& part) {
  write(path, "[geometry]\n" + source +
                  "\n[geometry.materials.aluminium]\nyoungs_modulus = \"70 GPa\"\n"
                  "poissons_ratio = 0.33\ndensity = \"2700 kg/m^3\"\nparts = [\"" +
                  part + "\"]\n");
}

/// A box, and the commands by which gmsh writes it.
constexpr const char* kBox = R"(
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 40, 20, 20};
Mesh.MeshSizeMin = 20;
Mesh.ElementOrder = 2;
Physical Volume("box", 1) = {1};
Save "box.step";
Save "box.brep";
Mesh 3;
Mesh.MshFileVersion = 4.1;
Save "box.msh";
Save "box.unv";
)";

void write_box(const fs::path& folder) {
  write(folder / "box.geo", kBox);
  write_study(folder / "box.toml", "script = \"box.geo\"", "box");
  const CommandOutcome outcome = run_flexneck(folder, "mesh box.toml -o made");
  INFO(outcome.text);
  REQUIRE(outcome.exit_code == 0);
}

void check_same(const mesher::Mesh& a, const mesher::Mesh& b) {
  CHECK(a.nodes == b.nodes);
  REQUIRE(a.blocks.size() == b.blocks.size());
  for (std::size_t k = 0; k < a.blocks.size(); ++k) {
    CHECK(a.blocks[k].part == b.blocks[k].part);
    CHECK(a.blocks[k].kind == b.blocks[k].kind);
    CHECK(a.blocks[k].nodes == b.blocks[k].nodes);
  }
  REQUIRE(a.face_sets.size() == b.face_sets.size());
  REQUIRE(a.node_sets.size() == b.node_sets.size());
  for (std::size_t k = 0; k < a.node_sets.size(); ++k) {
    CHECK(a.node_sets[k].name == b.node_sets[k].name);
    CHECK(a.node_sets[k].nodes == b.node_sets[k].nodes);
  }
}

/// The text with `from`, which must be there, replaced once.
std::string with(std::string text, const std::string& from, const std::string& to) {
  const std::size_t place = text.find(from);
  REQUIRE(place != std::string::npos);
  return text.replace(place, from.size(), to);
}

}  // namespace

TEST_CASE("without a folder for temporary files nothing is meshed, which one line says") {
  const TemporaryFolder folder;
  testing::check_refused(
      testing::run_shell("cd " + folder.path().string() + " && TMPDIR=missing " +
                         testing::flexneck_program() + " -q mesh"),
      "TMPDIR: expected a folder for temporary files, found 'missing'; set it to a folder");
}

TEST_CASE("a file that crashes or hangs gmsh or OpenCASCADE is refused in one line") {
  const TemporaryFolder folder;
  const auto refused = [&](const std::string& file, const std::string& contents,
                           const std::string& reason) {
    write(folder / file, contents);
    write_study(folder / "study.toml", "file = \"" + file + "\"", "volume_1");
    check_refused(folder.path(), "mesh study.toml", file + ": " + reason);
  };
  write_box(folder.path());
  const std::string step = bytes_of(folder / "box.step");
  const std::string brep = bytes_of(folder / "box.brep");
  const std::string msh = bytes_of(folder / "box.msh");
  const std::string unv = bytes_of(folder / "box.unv");

  // A line whose point is a vector.
  const std::size_t line = step.find("= LINE('',#");
  REQUIRE(line != std::string::npos);
  const std::size_t comma = step.find(",#", line + 12);
  const std::string vector = step.substr(comma + 1, step.find(')', comma) - comma - 1);
  std::string crossed = step;
  crossed.replace(line + 10, comma - line - 10, vector);
  refused("crossed.step", crossed,
          "OpenCASCADE or gmsh crashed while reading it (Segmentation fault)");

  // OpenCASCADE searches for the end of an edge in missing text.
  refused("short.brep", brep.substr(0, brep.find("\nEd\n") + 8),
          "OpenCASCADE or gmsh did not finish reading it within ");

  // The file is read without complaint: an edge is far away in the parameters of its face.
  refused("far.brep",
          with(brep, "Curve2ds 24\n1 0 0 1 0 \n1 0 0 ", "Curve2ds 24\n1 0 0 1 0 \n1 1e19 0 "),
          "OpenCASCADE or gmsh did not finish reading it within ");

  // The header announces a block of 2^31 - 1 nodes, but there are none.
  std::istringstream lines(msh.substr(msh.find("$Nodes\n") + 7));
  std::string header;
  std::string block;
  std::getline(lines, header);
  std::getline(lines, block);
  refused("many.msh", with(msh, header + "\n" + block, header + "\n0 1 0 2147483647"),
          "gmsh needs more than 0.8 GB of memory to read it");

  // A tetrahedron of nine nodes.
  const std::size_t count = unv.find("10\n", unv.find("  2412\n"));
  REQUIRE(count != std::string::npos);
  refused("nine.unv", unv.substr(0, count) + " 9\n" + unv.substr(count + 3), "");
}

TEST_CASE("a shape whose mesh would not fit into memory is refused before it is meshed") {
  const TemporaryFolder folder;
  write_box(folder.path());
  write_study(folder / "study.toml", "file = \"box.step\"", "volume_1");
  // 16 cm^3 in cubes of a micrometre, with seven nodes each.
  check_refused(folder.path(), "mesh study.toml --set 'mesh.size=1 um'",
                "box.step: gmsh cannot mesh it: a mesh of about 1.12e+14 nodes needs about");
}

TEST_CASE("what OpenCASCADE complains of while it makes a shape of it is a warning") {
  const TemporaryFolder folder;
  write_box(folder.path());
  write(folder / "typo.step", with(bytes_of(folder / "box.step"), "#1 = ", "#1 ? "));
  write_study(folder / "study.toml", "file = \"typo.step\"", "volume_1");
  const CommandOutcome outcome = run_flexneck(folder.path(), "mesh study.toml");
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.text, Contains("Warning: ") && Contains("typo.step: OpenCASCADE reports: ") &&
                               Contains("ERR StepFile : Incorrect Syntax"));
  CHECK(outcome.text.find('\x1b') == std::string::npos);
}

TEST_CASE("a mesh that a child reads, and one that a child's script makes, are what they were") {
  const TemporaryFolder folder;
  write_box(folder.path());
  write_study(folder / "again.toml", "file = \"box.msh\"", "box");
  const CommandOutcome outcome = run_flexneck(folder.path(), "mesh again.toml -o again");
  INFO(outcome.text);
  REQUIRE(outcome.exit_code == 0);
  // The same calls are made in this process.
  mesher::ImportOptions options;
  options.file = folder / "box.msh";
  options.materials = {{"aluminium", 70e9, 0.33, 2700}};
  options.material_of_part = {{"box", "aluminium"}};
  check_same(mesher::read_mesh(folder / "again/mesh.h5").mesh, mesher::import_mesh(options, {}));
  mesher::ScriptMeshOptions script;
  script.script = folder / "box.geo";
  script.materials = options.materials;
  script.material_of_part = options.material_of_part;
  check_same(mesher::read_mesh(folder / "made/mesh.h5").mesh, mesher::mesh_script(script, {}));
}

TEST_CASE("what is no regular file is refused at once, under whatever ending") {
  const TemporaryFolder folder;
  REQUIRE(mkfifo((folder / "pipe.msh").c_str(), 0600) == 0);
  REQUIRE(mkfifo((folder / "pipe.inp").c_str(), 0600) == 0);
  REQUIRE(mkfifo((folder / "pipe.geo").c_str(), 0600) == 0);
  fs::create_symlink("/dev/zero", folder / "device.msh");
  fs::create_directory(folder / "folder.step");
  const auto refused = [&](const std::string& source, const std::string& reason) {
    write_study(folder / "study.toml", source, "bar");
    check_refused(folder.path(), "mesh study.toml", reason);
  };
  refused("file = \"pipe.msh\"", "pipe.msh: expected a file, found a pipe");
  refused("file = \"pipe.inp\"", "pipe.inp: expected a file, found a pipe");
  refused("script = \"pipe.geo\"", "pipe.geo: expected a file, found a pipe");
  refused("file = \"device.msh\"", "device.msh: expected a file, found a device");
  refused("file = \"folder.step\"", "folder.step: expected a file, found a folder");
  refused("file = \"none.unv\"", "none.unv: no such file");
}

TEST_CASE("an HDF5 file without a hash that crashes HDF5 is refused in one line") {
  const TemporaryFolder folder;
  const fs::path files = fs::path(FLEXNECK_SOURCE_DIR) / "tests/pipeline/process/variable_texts";
  // One byte of the length of the first text in the file, of variable length, is increased.
  const auto damaged = [&](const std::string& name) {
    std::string bytes = bytes_of(files / name);
    const std::size_t heap = bytes.find("GCOL");
    REQUIRE(heap != std::string::npos);
    bytes.at(heap + 16 + 8 + 3) = 1;
    return bytes;
  };
  for (const char* const name : {"mesh.h5", "modes.h5", "swing.h5"}) {
    write(folder / name, damaged(name));
    check_refused(folder.path(), std::string("info ") + name,
                  std::string(name) + ": HDF5 crashed while reading it (Segmentation fault)");
  }
  write(folder / "model.toml", R"(
[solver]
end_time = "1 ms"
[[body]]
name = "ground"
kind = "ground"
[[body]]
name = "bar"
kind = "deformable"
modes_file = "modes.h5"
damping_ratio = 0.1
)");
  check_refused(folder.path(), "simulate model.toml", "modes.h5: HDF5 crashed while reading it");
}
