// SPDX-License-Identifier: GPL-3.0-or-later
#include <fstream>
#include <numeric>
#include <string>

#include <catch2/catch.hpp>

#include "geometry/foundation/error.h"
#include "geometry/foundation/hdf5_file.h"
#include "geometry/foundation/provenance.h"
#include "geometry/foundation/temporary_folder.h"
#include "tests/support/run_command.h"

using Catch::Matchers::Contains;
using namespace flexneck;

namespace {

constexpr FileFormat kForeignFormat{"flexneck example", 2, "flexneck example"};
using Strings = std::vector<std::string>;

/// Files that h5py has written.
struct Foreign {
  Foreign() {
    std::ofstream(folder / "raw") << std::string(16, '\0');
    const auto made =
        testing::run_shell("/usr/bin/python3 " + std::string(FLEXNECK_SOURCE_DIR) +
                           "/tests/support/foreign_hdf5.py " + folder.path().string());
    INFO(made.text);
    REQUIRE(made.exit_code == 0);
  }
  TemporaryFolder folder;
};

}  // namespace

TEST_CASE("what another program writes in its own types is read") {
  const Foreign foreign;
  const Hdf5Reader file(foreign.folder / "foreign.h5", kForeignFormat);
  CHECK(file.trust() == Trust::foreign);
  CHECK(format_of(file.path()) == "flexneck example");
  CHECK(file.read_strings("/strings/variable") == Strings{"a", "", "ζ"});
  CHECK(file.read_strings("/strings/zeros") == Strings{"ab", "c"});
  CHECK(file.read_strings("/strings/spaces") == Strings{"ab", "c d"});
  for (const std::string& kind : file.members("/integers")) {
    if (kind == "beyond" || kind == "unsigned") continue;
    INFO(kind);
    CHECK(file.read_integers("/integers/" + kind, {2}) == std::vector<std::int32_t>{1, 100});
  }
  std::vector<double> values(1000);
  std::iota(values.begin(), values.end(), 0.0);
  for (const std::string& kind : file.members("/doubles")) {
    INFO(kind);
    CHECK(file.read_doubles("/doubles/" + kind, {1000}, "m") == values);
  }
  CHECK(file.double_attribute("/", "whole") == 7800);
  CHECK(read_provenance(file).program.empty());
}

TEST_CASE("what is not in the file, or more than fits, is refused before it is read") {
  const Foreign foreign;
  const Hdf5Reader file(foreign.folder / "foreign.h5", kForeignFormat);
  const auto check_refused = [&](const std::string& dataset, const std::string& reason) {
    INFO(dataset);
    CHECK_THROWS_WITH(file.read_doubles("/refused/" + dataset, {kAnyExtent}, "m"),
                      Contains("foreign.h5: /refused/" + dataset + ": ") && Contains(reason));
  };
  check_refused("lzf", "found filter 32000");
  check_refused("unwritten", "was never written");
  check_refused("holes", "was never written");
  check_refused("giant", "is larger than the file");
  check_refused("outside", "found external storage");
  check_refused("virtual", "found external storage");
  check_refused("link", "found a soft or external link");
  check_refused("circle", "found a soft or external link");
  CHECK(file.members("/refused").size() == 8);
  CHECK_THROWS_WITH(file.read_integers("/integers/beyond", {2}),
                    Contains("found a value out of range"));
  CHECK_THROWS_WITH(file.read_integers("/integers/unsigned", {2}),
                    Contains("found a value out of range"));
  CHECK_THROWS_WITH(file.integer_attribute("/", "huge"), Contains("out of the range"));
  CHECK_THROWS_WITH(file.string_attribute("/", "many"), Contains("to have one value"));
}
