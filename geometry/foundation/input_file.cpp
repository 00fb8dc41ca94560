// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/foundation/input_file.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <fcntl.h>

#include "geometry/foundation/error.h"
#include "geometry/foundation/files_read.h"
#include "geometry/foundation/regular_file.h"

namespace flexneck {

namespace {

/// True for failures that the user can mend; others are the system's.
bool is_users_fault(int reason) {
  constexpr std::array<int, 6> kUsers = {ENOENT, ENOTDIR, EACCES, ELOOP, ENAMETOOLONG, ENXIO};
  return std::find(kUsers.begin(), kUsers.end(), reason) != kUsers.end();
}

}  // namespace

FileDescriptor open_to_read(const std::filesystem::path& path) {
  note_read(path);
  size_of_file(path);  // refuses anything but a regular file
  // Without O_NONBLOCK, opening a pipe that has replaced the file would wait for a writer.
  FileDescriptor file(
      uninterrupted([&] { return ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK); }));
  if (!file) {
    const int reason = errno;
    const std::string text = path.string() + ": cannot be read (" + std::strerror(reason) + ")";
    if (is_users_fault(reason)) throw InputError(text);
    throw ComputationError(text);
  }
  return file;
}

std::size_t read_at(const FileDescriptor& file, std::uint64_t place, std::span<char> block,
                    const std::filesystem::path& path) {
  std::size_t done = 0;
  while (done < block.size()) {
    const ssize_t count = uninterrupted([&] {
      return ::pread(file.get(), block.data() + done, block.size() - done,
                     static_cast<off_t>(place + done));
    });
    if (count < 0) {
      throw ComputationError(path.string() + ": cannot be read (" + std::strerror(errno) + ")");
    }
    if (count == 0) break;
    done += static_cast<std::size_t>(count);
  }
  return done;
}

std::string text_of_file(const std::filesystem::path& path) {
  const FileDescriptor file = open_to_read(path);
  std::array<char, 1 << 16> block{};
  std::string text;
  for (;;) {
    const std::size_t count = read_at(file, text.size(), block, path);
    text.append(block.data(), count);
    if (count < block.size()) return text;
  }
}

}  // namespace flexneck
