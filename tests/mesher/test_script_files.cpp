// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>

#include <catch2/catch.hpp>

#include "geometry/foundation/files_read.h"
#include "geometry/foundation/temporary_folder.h"
#include "mesher/exchange/script_files.h"

namespace flexneck::mesher {
namespace {

namespace fs = std::filesystem;

void write(const fs::path& path, const std::string& text) { std::ofstream(path) << text; }

/// Names of the files noted for "main.geo" with the given text in a folder.
std::set<std::string> names_for(const TemporaryFolder& folder, const std::string& text) {
  write(folder / "main.geo", text);
  const FilesRead reads;
  note_script_files(folder / "main.geo");
  std::set<std::string> names;
  for (const FileRead& file : reads.files())
    names.insert(has_content(file)            ? fs::path(file.path).filename().string()
                 : is_unknown_here(file.hash) ? "unknown"
                                              : "missing");
  return names;
}

}  // namespace

TEST_CASE("files that a script names literally are noted, those that these name, too") {
  const TemporaryFolder folder;
  fs::create_directories(folder / "more");
  write(folder / "more/a.geo", "Merge 'b.step';  // from its own folder");
  write(folder / "more/b.step", "Include \"no script\";");
  write(folder / "shape.brep", "x");
  write(folder / "list.txt", "1 2");
  write(folder / "main.geo.opt", "Mesh.Algorithm = 1;");
  CHECK(names_for(folder,
                  "/* Include \"c.geo\"; */ // Merge \"d.geo\";\n"
                  "Printf(\"Include 'e.geo'; SystemCall 'f'\"); Merge = 1;\n"
                  "Include\n \"more/a.geo\"; v() = ShapeFromFile(\"shape.brep\");\n"
                  "l() = ListFromFile(\"list.txt\"); Include \"main.geo\";") ==
        std::set<std::string>{"main.geo", "a.geo", "b.step", "shape.brep", "list.txt",
                              "main.geo.opt"});
}

TEST_CASE("a script that may read anything is noted as such") {
  const TemporaryFolder folder;
  const char* const all[] = {"SystemCall \"make_geo\";",
                             "Include StrCat(\"a\", \".geo\");",
                             "Merge name;",
                             "d = GetEnv(\"W\");",
                             "Field[1] = ExternalProcess;",
                             "Field[1].FileName = \"size.txt\";",
                             "Plugin(FieldFromAmplitudePhase).MeshFile = \"a.msh\";"};
  for (const char* const text : all) {
    INFO(text);
    CHECK(names_for(folder, text).contains("unknown"));
  }
  CHECK_FALSE(names_for(folder, "W = 1;").contains("unknown"));
}

}  // namespace flexneck::mesher
