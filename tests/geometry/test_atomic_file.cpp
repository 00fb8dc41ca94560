// SPDX-License-Identifier: GPL-3.0-or-later
#include <cerrno>
#include <csignal>
#include <cstdarg>
#include <fcntl.h>
#include <filesystem>
#include <functional>
#include <string>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>
#include <vector>

#include <catch2/catch.hpp>

#include "geometry/foundation/error.h"
#include "geometry/foundation/hdf5_file.h"
#include "geometry/foundation/input_file.h"
#include "geometry/foundation/output_file.h"
#include "geometry/foundation/temporary_folder.h"
#include "tests/support/files.h"

using Catch::Matchers::Contains;
using namespace flexneck;
using testing::names_in;

namespace {

namespace fs = std::filesystem;

/// State of the simulated system calls below.
struct System {
  std::vector<std::string> log;   ///< calls so far, in order
  std::string failing;            ///< the call that fails with EIO
  bool has_unnamed_files = true;  ///< property of the file system
};
System& the_system() {
  static System system;
  return system;
}

/// Logs a call.
/// @return true if it must fail
bool fails(const std::string& call) {
  the_system().log.push_back(call);
  if (the_system().failing == call) errno = EIO;
  return the_system().failing == call;
}

}  // namespace

// These replace the C library's functions in this program.
extern "C" int open(const char* path, int flags, ...) {
  va_list arguments;
  va_start(arguments, flags);
  const mode_t mode = va_arg(arguments, mode_t);
  va_end(arguments);
  if ((flags & O_TMPFILE) == O_TMPFILE && !the_system().has_unnamed_files) {
    errno = EOPNOTSUPP;
    return -1;
  }
  return static_cast<int>(syscall(SYS_openat, AT_FDCWD, path, flags, mode));
}
extern "C" int fsync(int file) {
  return fails("sync") ? -1 : static_cast<int>(syscall(SYS_fsync, file));
}
extern "C" int rename(const char* from, const char* to) noexcept {
  return fails("rename") ? -1 : static_cast<int>(syscall(SYS_rename, from, to));
}

namespace {

const std::string kBefore = "what was there before";
constexpr FileFormat kFormat{"flexneck example", 1, "flexneck example"};

/// Ways to write a file of some 100 kB.
void write_hdf5(const fs::path& path) {
  const std::vector<double> values(6000, 1.5);
  Hdf5Writer file(path, kFormat);
  file.write("/group/values", values, {values.size()}, "m");
  file.append("/rows", values, {2}, "s");
  file.append("/rows", values, {2}, "s");
  file.commit();
}
void write_plain(const fs::path& path) { write_text(path, std::string(100000, 'x')); }

const std::vector<std::function<void(const fs::path&)>> kWriters = {write_hdf5, write_plain};

/// A folder with one file; each test restores the system calls.
struct Place {
  Place() {
    write_text(path, kBefore);
    the_system() = {};
  }
  ~Place() { the_system() = {}; }
  Place(const Place&) = delete;
  Place& operator=(const Place&) = delete;

  void check_untouched() const {
    CHECK(text_of_file(path) == kBefore);
    CHECK(names_in(folder.path()).size() == 1);
  }

  TemporaryFolder folder;
  fs::path path = folder / "result";
};

/// Simulates a full disk: files of this process do not grow beyond a size.
class SizeLimit {
 public:
  explicit SizeLimit(std::size_t bytes) {
    std::signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~SizeLimit() { setrlimit(RLIMIT_FSIZE, &before_); }
  SizeLimit(const SizeLimit&) = delete;
  SizeLimit& operator=(const SizeLimit&) = delete;

 private:
  rlimit before_{};
};

}  // namespace

TEST_CASE("wherever the disk is full, the failure is told and the file before it stays") {
  for (const auto& write : kWriters) {
    const Place place;
    write(place.folder / "whole");
    const std::size_t size = fs::file_size(place.folder / "whole");
    fs::remove(place.folder / "whole");
    // The last writes, of HDF5's tables and of the hash, are small: near the end every byte is
    // tried.
    for (std::size_t room = 0; room < size; room += room + 600 < size ? 497 : 1) {
      INFO(room);
      const SizeLimit limit(room);
      CHECK_THROWS_WITH(write(place.path), Contains("result: cannot be written (File too large)"));
      place.check_untouched();
    }
    write(place.path);
    CHECK(fs::file_size(place.path) == size);
  }
}

TEST_CASE("a file is on the disk before it takes its place, its name with the folder's sync") {
  for (const bool has_unnamed_files : {true, false}) {
    for (const auto& write : kWriters) {
      const Place place;
      the_system().has_unnamed_files = has_unnamed_files;
      write(place.path);
      sync_folder(place.folder.path());
      CHECK(the_system().log == std::vector<std::string>{"sync", "rename", "sync"});
      CHECK(names_in(place.folder.path()).size() == 1);
    }
  }
}

TEST_CASE("a file that others can make again takes its place without waiting for the disk") {
  const Place place;
  write_text(place.path, "drawn", Durability::none);
  CHECK(the_system().log == std::vector<std::string>{"rename"});
  CHECK(text_of_file(place.path) == "drawn");
}

TEST_CASE("a folder that does not reach the disk is told") {
  const Place place;
  the_system().failing = "sync";
  CHECK_THROWS_AS(sync_folder(place.folder.path()), ComputationError);
  CHECK_THROWS_AS(sync_folder(place.folder / "none"), ComputationError);
}

TEST_CASE("what fails while a file takes its place is told, and nothing is left behind") {
  for (const bool has_unnamed_files : {true, false}) {
    for (const std::string failing : {"sync", "rename"}) {
      for (const auto& write : kWriters) {
        const Place place;
        the_system().has_unnamed_files = has_unnamed_files;
        the_system().failing = failing;
        CHECK_THROWS_AS(write(place.path), ComputationError);
        place.check_untouched();
      }
    }
  }
  const Place place;
  fs::create_directory(place.folder / "in the way");
  CHECK_THROWS_WITH(write_plain(place.folder / "in the way"), Contains("Is a directory"));
  CHECK(names_in(place.folder.path()).size() == 2);
}

TEST_CASE("a file under way is seen by nobody and follows no link") {
  for (const bool has_unnamed_files : {true, false}) {
    const Place place;
    the_system().has_unnamed_files = has_unnamed_files;
    // All names that a writer could try are taken by links to a foreign file.
    const std::string own = ".flexneck-" + std::to_string(::getpid()) + "-";
    for (const std::string& name : {std::string("new.part"), own + "0.part", own + "1.part"})
      fs::create_symlink(place.path, place.folder / name);
    write_plain(place.folder / "new");
    CHECK(text_of_file(place.path) == kBefore);
    CHECK(names_in(place.folder.path()).size() == 5);
  }
  const Place place;
  const OutputFile one(place.path);
  const OutputFile other(place.path);  // as another process might
  place.check_untouched();
}

TEST_CASE("a pipe is refused, not waited for") {
  const TemporaryFolder folder;
  REQUIRE(::mkfifo((folder / "pipe").c_str(), 0600) == 0);
  CHECK_THROWS_WITH(text_of_file(folder / "pipe"), Contains("expected a file, found a pipe"));
  CHECK_THROWS_AS(text_of_file(folder / "none"), InputError);
  CHECK_THROWS_AS(text_of_file(folder.path()), InputError);
}
