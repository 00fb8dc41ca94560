// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace flexneck {

/// A file as it was when it was read.
struct FileRead {
  std::string path;  ///< absolute, as it was named: a link is followed when the file is looked at
  std::string hash;  ///< of its content, by hash_now()

  bool operator==(const FileRead&) const = default;
};

/// The hash of a file's content as hash_of_file() has it, and a word for one that is not there or
/// cannot be read: to come into being is a change, too.
std::string hash_now(const std::filesystem::path& path);

/// Collects the files that this thread opens to read while it lives, each once for each content,
/// those of child processes too, which tell their parent. What it has collected goes on to the one
/// around it, if there is any. Files in a TemporaryFolder count for nothing once that is gone.
class FilesRead {
 public:
  FilesRead();
  ~FilesRead();
  FilesRead(const FilesRead&) = delete;
  FilesRead& operator=(const FilesRead&) = delete;

  /// In the order of their first reading.
  const std::vector<FileRead>& files() const { return files_; }
  /// Drops what was collected, where the files' content is known otherwise.
  void forget() { files_.clear(); }

 private:
  friend void note_read(const FileRead& file);
  friend void forget_reads_in(const std::filesystem::path& folder);

  FilesRead* around_;
  std::vector<FileRead> files_;
};

// For those who collect in this thread; without any, nothing is done.

/// Before a file is opened: what changes afterwards then counts as a change.
void note_read(const std::filesystem::path& path);
/// A file that was read by another thread or process, or for an earlier use of what was kept.
void note_read(const FileRead& file);
void note_reads(const std::vector<FileRead>& files);
/// A file that reads what nobody knows, such as a script that runs commands: it is the same as
/// before for this process alone.
void note_unknown_reads(const std::filesystem::path& path);
/// Tells whether it is such a file, of whatever process.
bool is_unknown(const FileRead& file);
/// Tells whether its content was there and says all.
bool has_content(const FileRead& file);
/// Tells whether a hash is of such a file as this process has noted it.
bool is_unknown_here(const std::string& hash);
void forget_reads_in(const std::filesystem::path& folder);

}  // namespace flexneck
