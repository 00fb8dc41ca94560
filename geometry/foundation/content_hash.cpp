// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/foundation/content_hash.h"

#include <algorithm>
#include <cstdio>
#include <string_view>
#include <vector>

#define XXH_INLINE_ALL
#include <xxhash.h>

#include "geometry/foundation/error.h"
#include "geometry/foundation/file_seconds.h"
#include "geometry/foundation/input_file.h"

namespace flexneck {

namespace {

constexpr std::string_view kOurs = "flexneck, XXH3-128 of all after 512 bytes: ";
/// Beginning of every file written by this program and of no foreign one. If the rest of the block
/// differs, the file is damaged, not of another kind.
constexpr std::string_view kMark = kOurs.substr(0, 8);
constexpr std::size_t kDigits = 32;

std::string digits_of(const XXH128_hash_t& hash) {
  std::array<char, kDigits + 1> digits{};
  std::snprintf(digits.data(), digits.size(), "%016llx%016llx",
                static_cast<unsigned long long>(hash.high64),
                static_cast<unsigned long long>(hash.low64));
  return digits.data();
}

std::string hash_from(const FileDescriptor& file, std::uint64_t place,
                      const std::filesystem::path& path) {
  const FileClock clock(FileClock::Work::hash);
  XXH3_state_t state;
  XXH3_128bits_reset(&state);
  std::vector<char> block(std::size_t{1} << 18U);
  for (;;) {
    const std::size_t count = read_at(file, place, block, path);
    XXH3_128bits_update(&state, block.data(), count);
    if (count < block.size()) return digits_of(XXH3_128bits_digest(&state));
    place += count;
  }
}

HashBlock first_block(const FileDescriptor& file, const std::filesystem::path& path) {
  HashBlock found{};
  read_at(file, 0, found, path);
  return found;
}

bool is_ours(const HashBlock& block) {
  return std::string_view(block.data(), block.size()).starts_with(kMark);
}

/// True if the block is complete as written by this program. A text, such as a table whose first
/// column is called "flexneck", is not.
bool is_complete(const HashBlock& block) {
  const std::string_view text(block.data(), block.size());
  const std::size_t end = kOurs.size() + kDigits;
  return text.starts_with(kOurs) && text[end] == '\n' &&
         text.find_first_not_of('\0', end + 1) == std::string_view::npos;
}

}  // namespace

std::string hash_of_text(const std::string& text) {
  return digits_of(XXH3_128bits(text.data(), text.size()));
}

HashBlock hash_block_of(const FileDescriptor& file, const std::filesystem::path& path) {
  const std::string text = std::string(kOurs) + hash_from(file, kHashBlockSize, path) + "\n";
  HashBlock block{};
  std::copy(text.begin(), text.end(), block.begin());
  return block;
}

std::optional<std::string> carried_hash(const std::filesystem::path& path) {
  const HashBlock block = first_block(open_to_read(path), path);
  if (!is_ours(block)) return std::nullopt;
  return std::string(block.data() + kOurs.size(), kDigits);
}

std::string hash_of_file(const std::string& path) {
  const FileDescriptor file = open_to_read(path);
  const HashBlock block = first_block(file, path);
  return is_complete(block) ? std::string(block.data() + kOurs.size(), kDigits)
                            : hash_from(file, 0, path);
}

std::string computed_hash_of_file(const std::filesystem::path& path) {
  const FileDescriptor file = open_to_read(path);
  return hash_from(file, is_complete(first_block(file, path)) ? kHashBlockSize : 0, path);
}

Trust trust_of(const std::filesystem::path& path, const std::string& remedy) {
  const FileDescriptor file = open_to_read(path);
  const HashBlock found = first_block(file, path);
  if (!is_ours(found)) return Trust::foreign;
  if (found != hash_block_of(file, path)) {
    throw InputError(
        path.string() +
        ": the HDF5 file is truncated or damaged: its content does not match its hash; " + remedy);
  }
  return Trust::verified;
}

}  // namespace flexneck
