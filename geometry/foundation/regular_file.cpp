// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/foundation/regular_file.h"

#include <string>
#include <system_error>

#include "geometry/foundation/error.h"

namespace flexneck {

namespace fs = std::filesystem;

namespace {

const char* kind_of(fs::file_type type) {
  switch (type) {
    case fs::file_type::directory:
      return "a folder";
    case fs::file_type::fifo:
      return "a pipe";
    case fs::file_type::socket:
      return "a socket";
    case fs::file_type::block:
    case fs::file_type::character:
      return "a device";
    default:
      return "something else";
  }
}

}  // namespace

std::uintmax_t size_of_file(const fs::path& file) {
  std::error_code error;
  const fs::file_type type = fs::status(file, error).type();
  if (type == fs::file_type::not_found) throw InputError(file.string() + ": no such file");
  if (type == fs::file_type::regular) {
    const std::uintmax_t size = fs::file_size(file, error);
    if (!error) return size;
  }
  if (error) throw InputError(file.string() + ": cannot be read: " + error.message());
  throw InputError(file.string() + ": expected a file, found " + kind_of(type));
}

}  // namespace flexneck
