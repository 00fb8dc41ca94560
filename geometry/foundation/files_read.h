// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace flexneck {

/// A file as it was when it was read.
struct FileRead {
  std::string path;  ///< absolute, as it was named: links are followed when the file is opened
  std::string hash;  ///< hash of its content by hash_now()

  bool operator==(const FileRead&) const = default;
};

/// The hash of a file's content by hash_of_file(), or a word for a file that is missing or cannot
/// be read: if it appears later, that is a change, too.
std::string hash_now(const std::filesystem::path& path);

/// Collects the files that this thread opens to read during its lifetime, each once for each
/// content, including those of child processes, which report them to their parent. At its end the
/// collected files pass to the enclosing collector, if there is any. Files in a TemporaryFolder no
/// longer count once it is removed.
class FilesRead {
 public:
  FilesRead();
  ~FilesRead();
  FilesRead(const FilesRead&) = delete;
  FilesRead& operator=(const FilesRead&) = delete;

  /// The files in the order of their first reading.
  const std::vector<FileRead>& files() const { return files_; }
  /// Drops the collected files, where their content is known by other means.
  void forget() { files_.clear(); }

 private:
  friend void note_read(const FileRead& file);
  friend void forget_reads_in(const std::filesystem::path& folder);

  FilesRead* around_;
  std::vector<FileRead> files_;
};

// Functions that report to the collectors of this thread; without any collector they do nothing.

/// Notes a file before it is opened: a later change of its content then counts as a change.
void note_read(const std::filesystem::path& path);
/// Notes a file that was read by another thread or process, or when a cached result was computed.
void note_read(const FileRead& file);
void note_reads(const std::vector<FileRead>& files);
/// Notes a file that reads unknown files, such as a script that runs commands: its hash is valid
/// within this process alone.
void note_unknown_reads(const std::filesystem::path& path);
/// Returns whether the file reads unknown files, noted by whatever process.
bool is_unknown(const FileRead& file);
/// Returns whether the file existed and its hash covers all that it reads.
bool has_content(const FileRead& file);
/// Returns whether the hash is this process's hash of a file with unknown reads.
bool is_unknown_here(const std::string& hash);
void forget_reads_in(const std::filesystem::path& folder);

}  // namespace flexneck
