// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

#include "geometry/foundation/durability.h"
#include "geometry/foundation/file_descriptor.h"
#include "geometry/foundation/signal_cleanup.h"

namespace flexneck {

/// Brings the names of the files that have been put into a folder to the disk.
/// @throws ComputationError if that fails.
void sync_folder(const std::filesystem::path& folder);

/// A file that appears under its name whole or not at all. Until commit() it has no name, so that
/// nothing stays behind however the process ends; where the file system knows no files without
/// names (NFS), a fresh one beside its own, which only a killed process leaves behind.
class AtomicFile {
 public:
  /// @throws InputError if the folder cannot be written.
  explicit AtomicFile(std::filesystem::path path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  const std::filesystem::path& path() const { return path_; }
  /// For reading back what was written.
  const FileDescriptor& descriptor() const { return file_; }

  /// C code may call these three. The first failure is kept, and nothing is written after it.
  void write_at(std::uint64_t place, std::span<const char> bytes) noexcept;
  /// Zeros where nothing was written.
  void read_at(std::uint64_t place, std::span<char> block) noexcept;
  void resize(std::uint64_t size) noexcept;

  /// @throws ComputationError with the system's reason if one of them has failed.
  void require_written() const;

  /// Has the system begin to write the content to the disk, for commit() to wait less.
  void start_sync() const noexcept;

  /// Brings the file to its place, instead of one that is there.
  /// @throws ComputationError if any of it fails; what was in the place before is still there then.
  void commit(Durability durability = Durability::content);

 private:
  void create();
  void name();
  void remove_temporary() noexcept;
  [[noreturn]] void fail(int reason) const;

  std::filesystem::path path_;
  std::filesystem::path folder_;
  std::filesystem::path temporary_;  ///< empty while the file has no name
  SignalCleanup cleanup_;            ///< of that name
  FileDescriptor file_;
  int failure_ = 0;  ///< the system's number of the first failure
};

}  // namespace flexneck
