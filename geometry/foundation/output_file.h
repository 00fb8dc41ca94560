// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "geometry/foundation/atomic_file.h"

namespace flexneck {

/// A file that is written from its beginning to its end and takes its place on commit(); without
/// commit() nothing is left.
class OutputFile {
 public:
  /// @throws InputError if the folder cannot be written.
  explicit OutputFile(std::filesystem::path path) : file_(std::move(path)) {}

  /// @throws ComputationError if writing has failed.
  void write(std::string_view text) {
    waiting_.append(text);
    if (waiting_.size() >= kBlock) write_waiting();
  }
  /// @throws ComputationError if writing has failed.
  void commit(Durability durability = Durability::content);

 private:
  static constexpr std::size_t kBlock = std::size_t{1} << 18U;

  void write_waiting();

  AtomicFile file_;
  std::string waiting_;
  std::uint64_t written_ = 0;
};

/// Writes a whole file at once.
/// @throws as OutputFile does.
void write_text(const std::filesystem::path& path, std::string_view text,
                Durability durability = Durability::content);

// Texts of numbers. They do not depend on the locale, which the calling program may choose.

/// The shortest text that reads back as the same number.
std::string exact_text(double number);
/// The most accurate text of at most `width` characters.
std::string text_within(double number, int width);
/// Rounded text for messages, as C's "%.6g" gives it where the decimal sign is a point.
std::string rounded_text(double number, int digits = 6);
/// Text with a fixed number of decimals, as C's "%.2f" gives it.
std::string fixed_text(double number, int decimals);
/// Several rounded texts: "1, 2.5, 3".
std::string rounded_texts(std::span<const double> numbers, int digits = 6);

}  // namespace flexneck
