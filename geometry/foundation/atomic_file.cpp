// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/foundation/atomic_file.h"

#include <algorithm>
#include <cstring>
#include <fcntl.h>
#include <string>
#include <utility>

#include "geometry/foundation/error.h"
#include "geometry/foundation/file_seconds.h"
#include "geometry/foundation/fresh_name.h"

namespace flexneck {

namespace fs = std::filesystem;

namespace {

constexpr mode_t kPermissions = 0666;  ///< masked by the user's umask

bool sync(int descriptor) {
  const FileClock clock(FileClock::Work::sync);
  return uninterrupted([&] { return ::fsync(descriptor); }) == 0;
}

}  // namespace

void sync_folder(const fs::path& folder) {
  const FileDescriptor entries(
      uninterrupted([&] { return ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC); }));
  // Some file systems have nothing to sync in a folder and report EINVAL.
  if (entries && (sync(entries.get()) || errno == EINVAL)) return;
  throw ComputationError(folder.string() + ": cannot be written (" + std::strerror(errno) + ")");
}

AtomicFile::AtomicFile(fs::path path)
    : path_(std::move(path)),
      folder_(path_.has_parent_path() ? path_.parent_path() : fs::path(".")) {
  create();
  if (file_) return;
  throw InputError(path_.string() + ": cannot be written (" + std::strerror(errno) +
                   "); choose another folder with -o");
}

AtomicFile::~AtomicFile() { remove_temporary(); }

void AtomicFile::create() {
  file_ = FileDescriptor(uninterrupted(
      [&] { return ::open(folder_.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, kPermissions); }));
  const bool has_unnamed_files = file_ || (errno != EOPNOTSUPP && errno != EISDIR);
  if (has_unnamed_files) return;
  const SignalHold hold;
  temporary_ = take_fresh_name(folder_, [&](const fs::path& name) {
    constexpr int kFlags = O_CREAT | O_EXCL | O_NOFOLLOW | O_RDWR | O_CLOEXEC;
    file_ =
        FileDescriptor(uninterrupted([&] { return ::open(name.c_str(), kFlags, kPermissions); }));
    return static_cast<bool>(file_);
  });
  cleanup_ = SignalCleanup(SignalCleanup::Action::remove, temporary_);
}

void AtomicFile::name() {
  if (!temporary_.empty()) return;
  const SignalHold hold;
  const std::string unnamed = "/proc/self/fd/" + std::to_string(file_.get());
  temporary_ = take_fresh_name(folder_, [&](const fs::path& name) {
    return ::linkat(AT_FDCWD, unnamed.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) == 0;
  });
  if (temporary_.empty()) fail(errno);
  cleanup_ = SignalCleanup(SignalCleanup::Action::remove, temporary_);
}

void AtomicFile::remove_temporary() noexcept {
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
  temporary_.clear();
  cleanup_.reset();
}

void AtomicFile::write_at(std::uint64_t place, std::span<const char> bytes) noexcept {
  while (failure_ == 0 && !bytes.empty()) {
    const ssize_t count = uninterrupted([&] {
      return ::pwrite(file_.get(), bytes.data(), bytes.size(), static_cast<off_t>(place));
    });
    if (count <= 0) {
      failure_ = count < 0 ? errno : ENOSPC;
      return;
    }
    bytes = bytes.subspan(static_cast<std::size_t>(count));
    place += static_cast<std::uint64_t>(count);
  }
}

void AtomicFile::read_at(std::uint64_t place, std::span<char> block) noexcept {
  while (failure_ == 0 && !block.empty()) {
    const ssize_t count = uninterrupted([&] {
      return ::pread(file_.get(), block.data(), block.size(), static_cast<off_t>(place));
    });
    if (count < 0) failure_ = errno;
    if (count <= 0) break;
    block = block.subspan(static_cast<std::size_t>(count));
    place += static_cast<std::uint64_t>(count);
  }
  std::fill(block.begin(), block.end(), '\0');
}

void AtomicFile::resize(std::uint64_t size) noexcept {
  if (failure_ != 0) return;
  if (uninterrupted([&] { return ::ftruncate(file_.get(), static_cast<off_t>(size)); }) != 0) {
    failure_ = errno;
  }
}

void AtomicFile::require_written() const {
  if (failure_ != 0) fail(failure_);
}

void AtomicFile::start_sync() const noexcept {
  ::sync_file_range(file_.get(), 0, 0, SYNC_FILE_RANGE_WRITE);
}

void AtomicFile::commit(Durability durability) {
  require_written();
  if (durability == Durability::content && !sync(file_.get())) fail(errno);
  name();
  if (!file_.close()) fail(errno);
  const SignalHold hold;
  if (::rename(temporary_.c_str(), path_.c_str()) != 0) fail(errno);
  temporary_.clear();
  cleanup_.reset();
}

void AtomicFile::fail(int reason) const {
  throw ComputationError(path_.string() + ": cannot be written (" + std::strerror(reason) + ")");
}

}  // namespace flexneck
