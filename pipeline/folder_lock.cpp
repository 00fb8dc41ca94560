// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/folder_lock.h"

#include <array>
#include <cstring>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <utility>

#include "geometry/foundation/error.h"
#include "geometry/foundation/input_file.h"
#include "pipeline/results_folder.h"

namespace flexneck::pipeline {

namespace fs = std::filesystem;

namespace {

std::string host_name() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "an unknown host";
}

}  // namespace

FolderLock::FolderLock(fs::path folder, const std::string& command, const Progress& warn)
    : folder_(std::move(folder)), path_(folder_ / ".flexneck.lock") {
  is_made_ = !fs::exists(folder_);
  ResultsFolder(folder_).make();
  if (take()) {
    sign(command);
  } else {
    warn(folder_.string() +
         ": this file system has no locks; see to it that no other command "
         "writes there");
  }
}

FolderLock::~FolderLock() {
  if (file_) ::unlink(path_.c_str());
  if (is_made_) ::rmdir(folder_.c_str());  // not if there is anything in it
}

bool FolderLock::take() {
  // A lock on a file that its last holder has removed meanwhile is worth nothing.
  do {
    constexpr int kFlags = O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC;
    file_ = FileDescriptor(uninterrupted([&] { return ::open(path_.c_str(), kFlags, 0666); }));
    if (!file_) refuse(std::string("cannot be written (") + std::strerror(errno) + ")");
    if (uninterrupted([&] { return ::flock(file_.get(), LOCK_EX | LOCK_NB); }) == 0) continue;
    if (errno != EWOULDBLOCK) {
      ::unlink(path_.c_str());
      file_.close();
      return false;
    }
    refuse("is in use by " + holder() + "; wait for it");
  } while (!is_in_place());
  return true;
}

std::string FolderLock::holder() const {
  std::array<char, 512> text{};
  const std::size_t size = read_at(file_, 0, text, path_);
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
  if (::ftruncate(file_.get(), 0) != 0 ||
      ::pwrite(file_.get(), text.data(), text.size(), 0) != static_cast<ssize_t>(text.size())) {
    refuse(std::string("cannot be written (") + std::strerror(errno) + ")");
  }
}

void FolderLock::refuse(const std::string& problem) const {
  throw InputError(folder_.string() + ": " + problem + ", or choose another folder with -o");
}

}  // namespace flexneck::pipeline
