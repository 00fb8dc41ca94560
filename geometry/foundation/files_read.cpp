// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/foundation/files_read.h"

#include <algorithm>
#include <chrono>
#include <system_error>
#include <unistd.h>
#include <utility>

#include "geometry/foundation/content_hash.h"
#include "geometry/foundation/error.h"

namespace flexneck {

namespace fs = std::filesystem;

namespace {

constexpr const char* kMissing = "missing";
constexpr const char* kUnknown = "unknown";

/// The innermost collector of this thread.
FilesRead*& innermost() {
  thread_local FilesRead* collector = nullptr;
  return collector;
}

/// Hash of a file with unknown reads; it differs from process to process.
const std::string& unknown_hash() {
  static const std::string hash =
      std::string(kUnknown) + "-" + std::to_string(::getpid()) + "-" +
      std::to_string(std::chrono::system_clock::now().time_since_epoch().count());
  return hash;
}

/// Stops the collecting in this thread during its scope.
class Pause {
 public:
  Pause() : collector_(std::exchange(innermost(), nullptr)) {}
  ~Pause() { innermost() = collector_; }
  Pause(const Pause&) = delete;
  Pause& operator=(const Pause&) = delete;

 private:
  FilesRead* collector_;
};

}  // namespace

std::string hash_now(const fs::path& path) {
  try {
    std::error_code none;
    return fs::is_regular_file(path, none) ? hash_of_file(path.string()) : kMissing;
  } catch (const InputError&) {  // no permission to read it
    return kMissing;
  }
}

FilesRead::FilesRead() : around_(std::exchange(innermost(), this)) {}

FilesRead::~FilesRead() {
  innermost() = around_;
  note_reads(files_);
}

void note_read(const FileRead& file) {
  FilesRead* const collector = innermost();
  if (collector == nullptr) return;
  // An unknown file of a child process becomes one of this process.
  const FileRead noted{file.path, is_unknown(file) ? unknown_hash() : file.hash};
  std::vector<FileRead>& files = collector->files_;
  if (std::find(files.begin(), files.end(), noted) == files.end()) files.push_back(noted);
}

void note_read(const fs::path& path) {
  if (innermost() == nullptr) return;
  FileRead file{fs::absolute(path).string(), {}};
  {
    const Pause pause;  // hashing opens the file, too
    file.hash = hash_now(path);
  }
  note_read(file);
}

void note_reads(const std::vector<FileRead>& files) {
  for (const FileRead& file : files) note_read(file);
}

void note_unknown_reads(const fs::path& path) {
  note_read(FileRead{fs::absolute(path).string(), kUnknown});
}

bool is_unknown(const FileRead& file) { return file.hash.starts_with(kUnknown); }

bool has_content(const FileRead& file) { return file.hash != kMissing && !is_unknown(file); }

bool is_unknown_here(const std::string& hash) { return hash == unknown_hash(); }

void forget_reads_in(const fs::path& folder) {
  const std::string beginning = fs::absolute(folder).string() + "/";
  for (FilesRead* collector = innermost(); collector != nullptr; collector = collector->around_)
    std::erase_if(collector->files_,
                  [&](const FileRead& file) { return file.path.starts_with(beginning); });
}

}  // namespace flexneck
