// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/foundation/text_file.h"

#include <algorithm>
#include <array>

#include "geometry/foundation/error.h"
#include "geometry/foundation/input_file.h"
#include "geometry/foundation/printable.h"

namespace flexneck {

namespace {

std::string contents_of(const std::filesystem::path& path, std::size_t max_bytes) {
  const FileDescriptor file = open_to_read(path);
  std::array<char, 1 << 16> block{};
  std::string text;
  for (;;) {
    const std::size_t count = read_at(file, text.size(), block, path);
    text.append(block.data(), count);
    if (text.size() > max_bytes) {
      throw InputError(path.string() + ": expected at most " + std::to_string(max_bytes >> 10U) +
                       " KiB of text, found more");
    }
    if (count < block.size()) return text;
  }
}

}  // namespace

std::string read_text(const std::filesystem::path& path, std::size_t max_bytes) {
  std::string text = contents_of(path, max_bytes);
  if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
  const std::size_t place = find_unprintable(text, "\t\n\r");
  if (place == std::string::npos) return text;
  const auto line =
      std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(place), '\n');
  throw InputError(path.string() + ":" + std::to_string(line + 1) +
                   ": expected UTF-8 without control characters, found " +
                   printable(text.substr(place, 1)));
}

}  // namespace flexneck
