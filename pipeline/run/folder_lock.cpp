// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/run/folder_lock.h"

#include <array>
#include <chrono>
#include <cstring>
#include <fcntl.h>
#include <string_view>
#include <sys/file.h>
#include <sys/stat.h>
#include <thread>
#include <utility>

#include "geometry/foundation/error.h"
#include "geometry/foundation/input_file.h"
#include "pipeline/run/results_folder.h"

namespace flexneck::pipeline {

namespace fs = std::filesystem;
using Action = SignalCleanup::Action;

namespace {

std::string host_name() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "an unknown host";
}

/// Writes to an empty file. @return false with errno if not all of it could be written
bool write_all(const FileDescriptor& file, std::string_view text) {
  std::size_t done = 0;
  while (done < text.size()) {
    const ssize_t count = uninterrupted([&] {
      return ::pwrite(file.get(), text.data() + done, text.size() - done, static_cast<off_t>(done));
    });
    if (count <= 0) return false;
    done += static_cast<std::size_t>(count);
  }
  return true;
}

}  // namespace

FolderLock::FolderLock(fs::path folder, const std::string& command, const Progress& warn)
    : folder_(std::move(folder)), path_(folder_ / ".flexneck.lock") {
  is_made_ = !fs::exists(folder_);
  try {
    take();
    if (is_fixed_) sign(command);
  } catch (...) {
    release();
    throw;
  }
  if (!is_fixed_) {
    warn(folder_.string() +
         ": this file system has no locks; make sure that no other command writes to this folder");
  }
}

FolderLock::~FolderLock() { release(); }

void FolderLock::release() noexcept {
  if (is_fixed_) ::unlink(path_.c_str());
  if (is_made_) ::rmdir(folder_.c_str());  // fails if the folder is not empty
}

void FolderLock::open() {
  // A command that ends may remove the folder after it was found.
  for (int attempts = 10; !file_ && attempts > 0; --attempts) {
    ResultsFolder(folder_).make();
    if (is_made_) folder_cleanup_ = SignalCleanup(Action::remove_empty_folder, folder_);
    constexpr int kFlags = O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC;
    file_ = FileDescriptor(uninterrupted([&] { return ::open(path_.c_str(), kFlags, 0666); }));
    if (!file_ && errno != ENOENT) break;
  }
  if (!file_) refuse(std::string("cannot be written (") + std::strerror(errno) + ")");
}

void FolderLock::take() {
  const SignalHold hold;
  // A lock on a file that its last holder has removed meanwhile has no effect.
  do {
    file_.close();
    open();
    if (uninterrupted([&] { return ::flock(file_.get(), LOCK_EX | LOCK_NB); }) == 0) continue;
    if (errno != EWOULDBLOCK) {
      ::unlink(path_.c_str());
      file_.close();
      return;
    }
    refuse("is in use by " + holder() + "; wait for it");
  } while (!is_in_place());
  is_fixed_ = true;
  lock_cleanup_ = SignalCleanup(Action::remove, path_);
}

std::string FolderLock::holder() const {
  std::array<char, 512> text{};
  std::size_t size = 0;
  // The holder may not have written its name yet.
  for (int attempts = 100; size == 0 && attempts > 0; --attempts) {
    size = read_at(file_, 0, text, path_);
    if (size == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return size == 0 ? "another command" : std::string(text.data(), size);
}

bool FolderLock::is_in_place() const {
  struct stat mine {};
  struct stat there {};
  return ::fstat(file_.get(), &mine) == 0 && ::stat(path_.c_str(), &there) == 0 &&
         mine.st_ino == there.st_ino && mine.st_dev == there.st_dev;
}

void FolderLock::sign(const std::string& command) const {
  const std::string text =
      "'" + command + "', process " + std::to_string(::getpid()) + " on " + host_name();
  if (uninterrupted([&] { return ::ftruncate(file_.get(), 0); }) != 0 || !write_all(file_, text))
    refuse(std::string("cannot be written (") + std::strerror(errno) + ")");
}

void FolderLock::refuse(const std::string& problem) const {
  throw InputError(folder_.string() + ": " + problem + ", or choose another folder with -o");
}

}  // namespace flexneck::pipeline
