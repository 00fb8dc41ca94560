// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <utility>

#include <catch2/catch.hpp>
#include <gmsh.h>

#include "geometry/foundation/temporary_folder.h"
#include "mesher/exchange/foreign_file.h"
#include "mesher/gmsh/gmsh_session.h"
#include "tests/mesher/exchange/files.h"

namespace flexneck::mesher {
namespace {

using Catch::Matchers::Contains;
using testing::Files;
using testing::kTetrahedronMsh;

/// A script that leaves a file behind when it runs.
class Payload {
 public:
  std::string script() const { return "SystemCall \"touch " + trace_.string() + "\";\n"; }
  bool has_run() const { return std::filesystem::exists(trace_); }
  void forget() const { std::filesystem::remove(trace_); }

 private:
  TemporaryFolder folder_;
  std::filesystem::path trace_ = folder_ / "trace";
};

}  // namespace

TEST_CASE("gmsh itself runs a script whatever its ending, and the options beside a mesh") {
  const Payload payload;
  const Files files;
  GmshSession session;
  for (const char* const name : {"mesh.msh", "mesh.inp", "mesh.pos"}) {
    INFO(name);
    static_cast<void>(session.errors_of([&] { gmsh::merge(files.write(name, payload.script())); }));
    CHECK(payload.has_run());  // otherwise the tests below prove nothing
    payload.forget();
  }
  const auto mesh = files.write("good.msh", kTetrahedronMsh);
  files.write("good.msh.opt", payload.script());
  static_cast<void>(session.errors_of([&] { gmsh::merge(mesh); }));
  CHECK(payload.has_run());
}

TEST_CASE("a script under the name of a mesh is refused and does not run") {
  const Payload payload;
  const Files files;
  const std::string script = payload.script();
  const std::string mesh = kTetrahedronMsh;
  const std::string header = mesh.substr(0, mesh.find("$PhysicalNames"));
  const std::string in_section = "$Comments\n" + script + "$EndComments\n";
  const std::vector<std::pair<std::string, std::string>> hostile = {
      {"plain.msh", script},
      {"plain.MSH", script},
      {"plain.inp", script},
      {"plain.unv", script},
      {"plain.bdf", script},
      {"plain.nas", script},
      {"plain.step", script},
      {"plain.stp", script},
      {"plain.brep", script},
      {"empty_line.msh", "\n" + script},
      {"blanks.msh", "  " + mesh},
      {"header.msh", header + script},
      {"after.msh", mesh + script},
      {"between.msh", header + script + mesh.substr(header.size())},
      {"first_line.msh", "$MeshFormat " + script + mesh.substr(12)},
      {"version.msh", "$MeshFormat\n1.0 0 8\n$EndMeshFormat\n" + in_section},
      {"old.msh", "$NOD\n1\n1 0 0 0\n$ENDNOD\n" + script},
      {"post.msh", "$PostFormat\n1.4 0 8\n$EndPostFormat\n" + script},
      {"mac_lines.msh", "$MeshFormat\r" + script},
      {"data_set.unv", "    -1\n" + script},
      {"comment.step", "/* ISO-10303-21; */\n" + script},
  };
  for (const auto& [name, contents] : hostile) {
    INFO(name);
    CHECK_THAT(testing::refusal(testing::import_options(files.write(name, contents), {"corner"})),
               Contains(name) && Contains("not a valid "));
    CHECK_FALSE(payload.has_run());
  }
}

TEST_CASE("data that a reader passes over runs nothing either") {
  const Payload payload;
  const Files files;
  const std::string script = payload.script();
  const std::string mesh = kTetrahedronMsh;
  // gmsh looks for the next section it knows; a Nastran reader for the next card.
  files.write("with_section.msh", mesh + "$Comments\n" + script + "$EndComments\n");
  files.write("cards.bdf", script + "GRID,1,,0.,0.,0.\nCTETRA,1,1,1,1,1,1\n" + script);
  files.write("sets.unv", "    -1\n  2411\n    -1\n" + script);
  files.write("cards.inp", "*NODE\n1,0,0,0\n*INCLUDE,INPUT=script.geo\n");
  files.write("script.geo", script);
  for (const char* const name : {"with_section.msh", "cards.bdf", "sets.unv", "cards.inp"}) {
    INFO(name);
    static_cast<void>(testing::refusal(testing::import_options(files / name, {"corner"})));
    CHECK_FALSE(payload.has_run());
  }
}

TEST_CASE("a .msh in bytes that ends within its header is refused") {
  const Files files;
  const std::string one("\1\0\0\0", 4);
  for (const std::string& rest : {one, one + "\n", one + "\n$EndMeshFormat\n"}) {
    const auto file = files.write("cut.msh", "$MeshFormat\n4.1 1 8\n" + rest);
    CHECK_THROWS_WITH(checked_contents(file), Contains("cut.msh: not a valid .msh file"));
  }
}

TEST_CASE("what lies beside a mesh is left alone, and a name is only a name") {
  const Payload payload;
  const Files files;
  files.write("good.msh.opt", payload.script());
  files.write("good.opt", payload.script());
  files.write(".gmshrc", payload.script());
  files.write(".gmsh-options", payload.script());
  const auto good = files.write("good.msh", kTetrahedronMsh);
  CHECK(testing::refusal(testing::import_options(good, {"corner"})) == "accepted");
  const std::string trick = "a; " + payload.script().substr(12, 5) + " x.msh";
  CHECK(testing::refusal(testing::import_options(files.write(trick, kTetrahedronMsh),
                                                 {"corner"})) == "accepted");
  CHECK_FALSE(payload.has_run());
}

TEST_CASE("the copy that gmsh gets lies alone under a name of ours and goes afterwards") {
  const Files files;
  const auto original = files.write("with blanks.MSH", kTetrahedronMsh);
  std::filesystem::path copied;
  {
    const CheckedCopy copy(original);
    copied = copy.path();
    CHECK(copied.filename() == "mesh.msh");
    CHECK(copied.parent_path() != original.parent_path());
    CHECK(std::distance(std::filesystem::directory_iterator(copied.parent_path()), {}) == 1);
  }
  CHECK_FALSE(std::filesystem::exists(copied.parent_path()));
}

TEST_CASE("scripts, unknown endings and files that are none are refused") {
  const Files files;
  CHECK_THAT(testing::refusal(testing::import_options(files.write("a.geo", ""), {})),
             Contains("is a gmsh script") && Contains("key script"));
  CHECK_THAT(testing::refusal(testing::import_options(files.write("a.stl", ""), {})),
             Contains("expected a file with one of the extensions .msh"));
  CHECK_THAT(testing::refusal(testing::import_options(files / "none.msh", {})),
             Contains("none.msh: no such file"));
  CHECK_THAT(testing::refusal(testing::import_options(files.write("empty.msh", ""), {})),
             Contains("expected $MeshFormat"));
  const std::string mesh = kTetrahedronMsh;
  CHECK_THAT(testing::refusal(testing::import_options(
                 files.write("cut.msh", mesh.substr(0, mesh.size() / 2)), {})),
             Contains("section $Nodes has no end; the file is truncated"));
}

}  // namespace flexneck::mesher
