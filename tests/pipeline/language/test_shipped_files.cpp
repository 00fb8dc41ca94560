// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <fstream>
#include <set>

#include <catch2/catch.hpp>

#include "geometry/foundation/error.h"
#include "geometry/foundation/temporary_folder.h"
#include "pipeline/language/document/shipped_files.h"
#include "pipeline/language/study/file_kind.h"

namespace flexneck::pipeline {
namespace {

namespace fs = std::filesystem;

using Catch::Matchers::Contains;

fs::path touched(const fs::path& path) {
  std::ofstream(path) << "\n";
  return path;
}

}  // namespace

TEST_CASE("no two shipped studies or models have the same name, and each is found by it") {
  const std::vector<std::string> names = shipped_names();
  std::size_t files = 0;
  for (const char* const folder : {"pipeline/data/studies", "pipeline/data/studies/fits",
                                   "pipeline/data/models", "geometry/examples"})
    for (const auto& entry : fs::directory_iterator(fs::path(FLEXNECK_SOURCE_DIR) / folder))
      files += entry.path().extension() == ".toml" ? 1 : 0;
  CHECK(names.size() == files);
  const TemporaryFolder elsewhere;
  for (const std::string& name : names) {
    const fs::path found = named_file(name, elsewhere.path());
    CHECK(found.stem() == name);
    CHECK(fs::is_regular_file(found));
    CHECK(named_file(name + ".toml", elsewhere.path()) == found);
  }
}

TEST_CASE("a file that is here goes before a shipped one, with or without its ending") {
  const TemporaryFolder folder;
  fs::create_directory(folder / "chain");  // perhaps a folder of results
  CHECK(named_file("chain", folder.path()) == shipped_file("pipeline/data/models/chain.toml"));
  const fs::path own = touched(folder / "chain.toml");
  CHECK(named_file("chain", folder.path()) == own);
  CHECK(named_file("chain.toml", folder.path()) == own);
  const fs::path plain = touched(folder / "dummy");
  CHECK(named_file("dummy", folder.path()) == plain);
  // A name with a folder is a path.
  CHECK(named_file("sub/dummy.toml", folder.path()) == folder / "sub/dummy.toml");
}

TEST_CASE("a name that is neither here nor shipped is refused with the nearest one") {
  const TemporaryFolder folder;
  CHECK_THROWS_WITH(named_file("penulum.toml", folder.path()),
                    Contains("penulum.toml: no such file, and there is no shipped study or model "
                             "'penulum' (did you mean 'pendulum'?)"));
  CHECK_THROWS_AS(named_file("four_baar", folder.path()), InputError);
}

TEST_CASE("every shipped file is of the kind whose command takes it") {
  std::set<std::string> models;
  for (const std::string& name : shipped_names())
    if (kind_of_file(named_file(name)) == FileKind::model) models.insert(name);
  for (const char* const name : {"andrews", "chain", "dummy", "four_bar", "pendulum",
                                 "pendulum_chain", "static_chain", "static_test"})
    CHECK(models.count(name) == 1);
  for (const std::string& name : models)
    CHECK(fs::is_regular_file(shipped_file("pipeline/data/models/" + name + ".toml")));
}

}  // namespace flexneck::pipeline
