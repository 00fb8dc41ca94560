// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace flexneck::fuzz {

/// The fuzzer's bytes as a sequence of choices; zeros after the end.
class EditScript {
 public:
  EditScript(const std::uint8_t* data, std::size_t size) : rest_(data, size) {}

  bool is_done() const { return rest_.empty(); }
  std::uint8_t byte();
  /// A number from up to 8 bytes, little-endian.
  std::uint64_t number(std::size_t bytes);
  std::size_t below(std::size_t count) { return count == 0 ? 0 : number(2) % count; }
  template <class List>
  const auto& among(const List& list) {
    return list[below(std::size(list))];
  }
  /// A real, often a special one: not finite, huge, tiny, zero.
  double real();
  /// A small integer, one at the limit of a type, or any.
  std::int64_t integer();
  /// One of the known texts, or bytes of the script.
  std::string text(const std::vector<std::string>& known);

 private:
  std::span<const std::uint8_t> rest_;
};

}  // namespace flexneck::fuzz
