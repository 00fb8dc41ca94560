// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "geometry/foundation/atomic_folder.h"
#include "geometry/foundation/error.h"
#include "geometry/foundation/output_file.h"
#include "geometry/foundation/temporary_folder.h"
#include "tests/support/files.h"

using namespace flexneck;
using Catch::Matchers::Contains;
using testing::bytes_of;
using testing::names_in;

namespace fs = std::filesystem;

TEST_CASE("a folder appears whole in the place of one that is there, or not at all") {
  const TemporaryFolder in;
  const auto write = [&](const std::string& name, bool commit) {
    AtomicFolder folder(in / "results");
    write_text(folder / name, name);
    fs::create_directory(folder / "inner");
    write_text(folder / ("inner/" + name), name);
    CHECK(names_in(in.path()).size() == (fs::exists(in / "results") ? 2 : 1));
    if (commit) folder.commit();
  };
  write("a", false);
  CHECK(names_in(in.path()).empty());
  write("a", true);
  write("b", false);
  CHECK(names_in(in / "results") == std::vector<std::string>{"a", "inner"});
  write("b", true);
  CHECK(names_in(in.path()) == std::vector<std::string>{"results"});
  CHECK(names_in(in / "results") == std::vector<std::string>{"b", "inner"});
  CHECK(bytes_of(in / "results/inner/b") == "b");
  CHECK_THROWS_WITH(AtomicFolder(in / "none/results"), Contains("none/results: cannot be written"));
}
