// SPDX-License-Identifier: GPL-3.0-or-later
#include <fstream>
#include <limits>
#include <numeric>

#include <catch2/catch.hpp>

#include "geometry/foundation/error.h"
#include "geometry/foundation/hdf5_file.h"
#include "geometry/foundation/provenance.h"
#include "geometry/foundation/temporary_folder.h"
#include "tests/support/files.h"

using Catch::Matchers::Contains;
using namespace flexneck;
using flexneck::TemporaryFolder;
using testing::bytes_of;

namespace {

constexpr FileFormat kFormat{"flexneck example", 2, "flexneck example"};

void write_example(const std::filesystem::path& path) {
  Hdf5Writer file(path, kFormat);
  const std::vector<double> values = {1, 2, 3, 4, 5, 6};
  const std::vector<std::int32_t> indices = {7, 8};
  file.write("/group/values", values, {3, 2}, "m");
  file.write("/indices", indices, {2});
  file.write("/names", std::vector<std::string>{"a", "", "ζ"});
  file.write_attribute("/group", "mass", 1.5);
  file.commit();
}

}  // namespace

TEST_CASE("what was written comes back, and the same writes give the same bytes") {
  const TemporaryFolder folder;
  write_example(folder / "a.h5");
  write_example(folder / "b.h5");
  CHECK(bytes_of(folder / "a.h5") == bytes_of(folder / "b.h5"));

  const Hdf5Reader file(folder / "a.h5", kFormat);
  CHECK(file.read_doubles("/group/values", {3, kAnyExtent}, "m") ==
        std::vector<double>{1, 2, 3, 4, 5, 6});
  CHECK(file.read_integers("/indices", {2}) == std::vector<std::int32_t>{7, 8});
  CHECK(file.read_strings("/names") == std::vector<std::string>{"a", "", "ζ"});
  CHECK(file.double_attribute("/group", "mass") == 1.5);
  CHECK(file.string_attribute("/", "units") == "SI");
  CHECK(file.members("/group") == std::vector<std::string>{"values"});
  CHECK(file.members("/nowhere").empty());
  CHECK_FALSE(file.has("/group/values/deeper"));
}

TEST_CASE("a text that begins as our HDF5 files do is hashed as a whole") {
  const TemporaryFolder folder;
  const std::string text = "flexneck, XXH3-128 of all after 512 bytes: " + std::string(600, '1');
  for (const std::string& contents : {std::string("flexneck,s\n1,2\n"), text}) {
    std::ofstream(folder / "a.csv", std::ios::binary) << contents;
    CHECK(hash_of_file(folder / "a.csv") == hash_of_text(contents));
    CHECK(computed_hash_of_file(folder / "a.csv") == hash_of_text(contents));
  }
}

TEST_CASE("one flipped bit anywhere in a file of ours is found before HDF5 reads it") {
  const TemporaryFolder folder;
  write_example(folder / "a.h5");
  const std::string sound = bytes_of(folder / "a.h5");
  CHECK(trust_of(folder / "a.h5") == Trust::verified);
  CHECK(Hdf5Reader(folder / "a.h5", kFormat).trust() == Trust::verified);
  // The hash covers all that follows the block, as its text says.
  CHECK(sound.substr(0, 75) ==
        "flexneck, XXH3-128 of all after 512 bytes: " + hash_of_text(sound.substr(kHashBlockSize)));
  CHECK(carried_hash(folder / "a.h5") == computed_hash_of_file(folder / "a.h5"));
  // Without the mark at its beginning it is a foreign file with the same content.
  std::size_t accepted = 0;
  for (std::size_t k = 0; k < sound.size(); k += k < kHashBlockSize ? 1 : 7) {
    std::string flipped = sound;
    flipped[k] = static_cast<char>(flipped[k] ^ (1 << (k % 8)));
    std::ofstream(folder / "b.h5", std::ios::binary) << flipped;
    if (k >= kHashBlockSize)
      CHECK(carried_hash(folder / "b.h5") != computed_hash_of_file(folder / "b.h5"));
    try {
      const Hdf5Reader file(folder / "b.h5", kFormat);
      CHECK(file.trust() == Trust::foreign);
      CHECK(file.read_integers("/indices", {2}) == std::vector<std::int32_t>{7, 8});
      ++accepted;
    } catch (const InputError& error) {
      CHECK_THAT(error.what(), Contains("b.h5: the HDF5 file is truncated or damaged"));
    }
  }
  CHECK(accepted == std::string("flexneck").size());
}

TEST_CASE("rows that are appended one by one are those of one write, compressed") {
  const TemporaryFolder folder;
  const std::size_t rows = 10001;
  std::vector<double> values(6 * rows);
  std::iota(values.begin(), values.end(), 0.5);
  const auto write = [&](const std::string& name, std::size_t at_once) {
    Hdf5Writer file(folder / name, kFormat);
    const std::span<const double> all = values;
    for (std::size_t k = 0; k < rows; k += at_once) {
      const std::size_t count = std::min(at_once, rows - k);
      file.append("/long", all.subspan(6 * k, 6 * count), {2, 3}, "m");
      if (k < 100) file.append("/short", all.subspan(k, count), {}, "s");
    }
    file.append("/empty", {}, {3}, "kg");
    file.commit();
  };
  write("a.h5", 1);
  write("b.h5", 5000);
  const Hdf5Reader one(folder / "a.h5", kFormat);
  CHECK(one.read_doubles("/long", {rows, 2, 3}, "m") == values);
  CHECK(one.read_doubles("/short", {100}, "s") ==
        std::vector<double>(values.begin(), values.begin() + 100));
  CHECK(one.read_doubles("/empty", {0, 3}, "kg").empty());
  CHECK(Hdf5Reader(folder / "b.h5", kFormat).read_doubles("/long", {rows, 2, 3}, "m") == values);
  CHECK(std::filesystem::file_size(folder / "a.h5") < values.size() * sizeof(double) / 2);
}

TEST_CASE("rows have zeros in the place of numbers below the smallest normal one") {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder / "rows.h5";
  Hdf5Writer writer(path, kFormat);
  writer.append("/curve", std::vector<double>{2e-320, -5e-324, 1e-300, 0.25}, {}, "m/s^2");
  writer.commit();
  CHECK(Hdf5Reader(path, kFormat).read_doubles("/curve", {4}, "m/s^2") ==
        std::vector<double>{0, 0, 1e-300, 0.25});
}

TEST_CASE("a file that is not committed leaves nothing behind") {
  const TemporaryFolder folder;
  {
    Hdf5Writer file(folder / "a.h5", kFormat);
    file.write_attribute("/group", "mass", 1.5);
  }
  CHECK(std::filesystem::is_empty(folder.path()));
  CHECK_THROWS_WITH(Hdf5Writer(folder / "none/a.h5", kFormat), Contains("cannot be written"));
}

TEST_CASE("what does not fit is refused with file, dataset, expectation and remedy") {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder / "a.h5";
  write_example(path);
  const Hdf5Reader file(path, kFormat);
  CHECK_THROWS_WITH(file.read_doubles("/group/values", {3, 3}, "m"),
                    Contains("a.h5: /group/values: expected the shape (3, 3), found (3, 2)") &&
                        Contains("make it again with 'flexneck example'"));
  CHECK_THROWS_WITH(file.read_doubles("/group/values", {3, 2}, "s"), Contains("found 'm'"));
  CHECK_THROWS_WITH(file.read_doubles("/indices", {2}, "m"), Contains("another type"));
  CHECK_THROWS_WITH(file.read_doubles("/absent", {2}, "m"), Contains("found none"));
  CHECK_THROWS_WITH(file.read_doubles("/group", {2}, "m"), Contains("something else"));
  CHECK_THROWS_WITH(file.integer_attribute("/group", "mass"), Contains("one integer"));
  CHECK_THROWS_WITH(file.double_attribute("/group", "absent"),
                    Contains("'absent', found none") || Contains("attribute 'absent'"));
  CHECK_THROWS_WITH(Hdf5Reader(path, {"flexneck other", 1, "x"}),
                    Contains("expected the format 'flexneck other', found 'flexneck example'"));
  CHECK_THROWS_WITH(Hdf5Reader(path, {"flexneck example", 1, "x"}), Contains("found 2"));
}

TEST_CASE("missing, foreign and truncated files and values that are not finite are refused") {
  const TemporaryFolder folder;
  CHECK_THROWS_WITH(Hdf5Reader(folder / "none.h5", kFormat), Contains("no such file"));
  CHECK_THROWS_WITH(Hdf5Reader(folder.path(), kFormat), Contains("expected an HDF5 file"));
  std::ofstream(folder / "text.h5") << "not HDF5";
  CHECK_THROWS_WITH(Hdf5Reader(folder / "text.h5", kFormat), Contains("expected an HDF5 file"));

  write_example(folder / "cut.h5");
  const auto size = std::filesystem::file_size(folder / "cut.h5");
  std::filesystem::resize_file(folder / "cut.h5", size / 2);
  CHECK_THROWS_WITH(Hdf5Reader(folder / "cut.h5", kFormat), Contains("truncated"));

  {
    Hdf5Writer file(folder / "nan.h5", kFormat);
    const std::vector<double> values = {1, std::numeric_limits<double>::quiet_NaN()};
    file.write("/values", values, {2}, "m");
    file.commit();
  }
  const Hdf5Reader file(folder / "nan.h5", kFormat);
  CHECK_THROWS_WITH(file.read_doubles("/values", {2}, "m"), Contains("finite"));
}

TEST_CASE("a file takes its place after the work beside its commit, and not if that fails") {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder / "a.h5";
  const std::vector<double> values = {1, 2};
  Hdf5Writer failing(path, kFormat);
  failing.write("/values", values, {2}, "m");
  CHECK_THROWS_AS(failing.commit([] { throw ComputationError("no space"); }), ComputationError);
  CHECK(testing::names_in(folder.path()).empty());
  Hdf5Writer file(path, kFormat);
  file.write("/values", values, {2}, "m");
  bool was_there = true;
  file.commit([&] { was_there = std::filesystem::exists(path); });
  CHECK_FALSE(was_there);
  CHECK(Hdf5Reader(path, kFormat).read_doubles("/values", {2}, "m") == values);
}

TEST_CASE("provenance survives the file") {
  const TemporaryFolder folder;
  Provenance written;
  written.program = "flexneck test";
  written.git_hash = "abc";
  written.inputs = {{"study.toml", hash_of_text("text")}};
  written.parameters = {{"geometry.length", "5.66 in", Origin::published, "paper"},
                        {"modes.count", "10", Origin::synthetic, ""}};
  written.libraries = {{"gmsh", "4.8.4"}};
  {
    Hdf5Writer file(folder / "a.h5", kFormat);
    write_provenance(file, written);
    file.commit();
  }
  const Provenance read = read_provenance(Hdf5Reader(folder / "a.h5", kFormat));
  CHECK(read.program == written.program);
  CHECK(read.git_hash == written.git_hash);
  CHECK(read.libraries == written.libraries);
  REQUIRE(read.inputs.size() == 1);
  CHECK(read.inputs[0].hash == written.inputs[0].hash);
  REQUIRE(read.parameters.size() == 2);
  CHECK(read.parameters[0].key == "geometry.length");
  CHECK(read.parameters[0].value == "5.66 in");
  CHECK(read.parameters[0].origin == Origin::published);
  CHECK(read.parameters[1].origin == Origin::synthetic);
}

TEST_CASE("the hash of a text is the published one of XXH3") {
  // xxhsum -H2 of an empty input.
  CHECK(hash_of_text("") == "99aa06d3014798d86001c324468d497f");
}
