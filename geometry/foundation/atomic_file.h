// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

#include "geometry/foundation/durability.h"
#include "geometry/foundation/file_descriptor.h"
#include "geometry/foundation/signal_cleanup.h"

namespace flexneck {

/// Syncs a folder to the disk, and with it the names of the files that were put into it.
/// @throws ComputationError if that fails.
void sync_folder(const std::filesystem::path& folder);

/// A file that appears under its name whole or not at all. Until commit() it has no name, so that
/// nothing is left behind however the process ends. On a file system without unnamed files (NFS) it
/// has a fresh name beside its own, which only a killed process leaves behind.
class AtomicFile {
 public:
  /// @throws InputError if the folder cannot be written.
  explicit AtomicFile(std::filesystem::path path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  const std::filesystem::path& path() const { return path_; }
  /// Descriptor for reading back what was written.
  const FileDescriptor& descriptor() const { return file_; }

  /// C code may call these three members. The first failure is kept, and nothing is written after
  /// it.
  void write_at(std::uint64_t place, std::span<const char> bytes) noexcept;
  /// Reads a block; bytes never written are zeros.
  void read_at(std::uint64_t place, std::span<char> block) noexcept;
  void resize(std::uint64_t size) noexcept;

  /// @throws ComputationError with the system's reason if a call of write_at(), read_at() or
  /// resize() has failed.
  void require_written() const;

  /// Lets the system begin to write the content to the disk, so that commit() waits less.
  void start_sync() const noexcept;

  /// Moves the file to its place, where it replaces an existing one.
  /// @throws ComputationError if any step fails; an existing file is then still there.
  void commit(Durability durability = Durability::content);

 private:
  void create();
  void name();
  void remove_temporary() noexcept;
  [[noreturn]] void fail(int reason) const;

  std::filesystem::path path_;
  std::filesystem::path folder_;
  std::filesystem::path temporary_;  ///< empty while the file has no name
  SignalCleanup cleanup_;            ///< removes the temporary name
  FileDescriptor file_;
  int failure_ = 0;  ///< errno of the first failure
};

}  // namespace flexneck
