// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "geometry/foundation/error.h"

namespace flexneck {

// Serialisation of values to bytes and back, for data that leave a process and come back to the
// same program: numbers in the machine's byte order, lists preceded by their length. A class lists
// its fields either in a member archive(all), which calls all(field, field, …), or in a function
// archive(all, value) found by its argument. Reading and writing call the same function.

template <class Archive, class T>
concept HasArchiveMember = requires(Archive& all, T& value) {
  value.archive(all);
};

class ByteWriter {
 public:
  static constexpr bool kReads = false;

  template <class... T>
  void operator()(T&... values) {
    (put(values), ...);
  }
  const std::string& bytes() const { return bytes_; }

 private:
  void put_raw(const void* data, std::size_t size) {
    bytes_.append(static_cast<const char*>(data), size);
  }
  template <class T>
  void put(T& value) {
    if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>) {
      put_raw(&value, sizeof value);
    } else if constexpr (HasArchiveMember<ByteWriter, T>) {
      value.archive(*this);
    } else {
      archive(*this, value);
    }
  }
  void put_size(std::size_t size) {
    std::uint64_t count = size;
    put(count);
  }
  void put(std::string& text) {
    put_size(text.size());
    put_raw(text.data(), text.size());
  }
  template <class T>
  void put(std::vector<T>& list) {
    put_size(list.size());
    for (T& each : list) put(each);
  }
  template <class T>
  void put(std::optional<T>& value) {
    bool is_there = value.has_value();
    put(is_there);
    if (value) put(*value);
  }
  template <class... T>
  void put(std::variant<T...>& value) {
    put_size(value.index());
    std::visit([&](auto& each) { put(each); }, value);
  }
  template <class T, std::size_t N>
  void put(std::array<T, N>& list) {
    for (T& each : list) put(each);
  }
  template <class S, int R, int C, int O, int MR, int MC>
  void put(Eigen::Matrix<S, R, C, O, MR, MC>& matrix) {
    put_size(static_cast<std::size_t>(matrix.rows()));
    put_size(static_cast<std::size_t>(matrix.cols()));
    put_raw(matrix.data(), static_cast<std::size_t>(matrix.size()) * sizeof(S));
  }
  void put(Eigen::Quaterniond& q) { put(q.coeffs()); }

  std::string bytes_;
};

/// All members throw InputError if the bytes end too early or hold an impossible value.
class ByteReader {
 public:
  static constexpr bool kReads = true;

  explicit ByteReader(std::string_view bytes) : rest_(bytes) {}

  template <class... T>
  void operator()(T&... values) {
    (get(values), ...);
  }
  /// @throws InputError if bytes are left over.
  void finish() const {
    if (!rest_.empty()) refuse();
  }
  [[noreturn]] static void refuse() {
    throw InputError(
        "the archived model is damaged, or was made by another version of the program");
  }

 private:
  void get_raw(void* data, std::size_t size) {
    if (size > rest_.size()) refuse();
    if (size == 0) return;  // either pointer may be null then, which memcpy() does not allow
    std::memcpy(data, rest_.data(), size);
    rest_.remove_prefix(size);
  }
  template <class T>
  void get(T& value) {
    if constexpr (std::is_same_v<T, bool>) {
      std::uint8_t byte = 0;
      get_raw(&byte, 1);
      if (byte > 1) refuse();
      value = byte == 1;
    } else if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>) {
      get_raw(&value, sizeof value);
    } else if constexpr (HasArchiveMember<ByteReader, T>) {
      value.archive(*this);
    } else {
      archive(*this, value);
    }
  }
  /// Reads the number of items that follow; each takes at least one byte.
  std::size_t get_size() {
    std::uint64_t count = 0;
    get(count);
    if (count > rest_.size()) refuse();
    return static_cast<std::size_t>(count);
  }
  void get(std::string& text) {
    const std::size_t size = get_size();
    text.assign(rest_.substr(0, size));
    rest_.remove_prefix(size);
  }
  template <class T>
  void get(std::vector<T>& list) {
    const std::size_t size = get_size();
    list.clear();
    for (std::size_t k = 0; k < size; ++k) get(list.emplace_back());
  }
  template <class T>
  void get(std::optional<T>& value) {
    bool is_there = false;
    get(is_there);
    value.reset();
    if (is_there) get(value.emplace());
  }
  template <class... T>
  void get(std::variant<T...>& value) {
    const std::size_t index = get_size();
    if (index >= sizeof...(T)) refuse();
    std::size_t at = 0;
    ((at++ == index ? get(value.template emplace<T>()) : void()), ...);
  }
  template <class T, std::size_t N>
  void get(std::array<T, N>& list) {
    for (T& each : list) get(each);
  }
  template <class S, int R, int C, int O, int MR, int MC>
  void get(Eigen::Matrix<S, R, C, O, MR, MC>& matrix) {
    std::uint64_t rows = 0, columns = 0;  // one of an empty matrix may exceed the bytes that follow
    get(rows);
    get(columns);
    constexpr std::uint64_t kMost = std::numeric_limits<int>::max();
    const auto fits = [](std::uint64_t found, int fixed, int most) {
      return found <= (most == Eigen::Dynamic ? kMost : static_cast<std::uint64_t>(most)) &&
             (fixed == Eigen::Dynamic || found == static_cast<std::uint64_t>(fixed));
    };
    if (!fits(rows, R, MR) || !fits(columns, C, MC) ||
        (rows > 0 && columns > rest_.size() / sizeof(S) / rows))
      refuse();
    matrix.resize(static_cast<Eigen::Index>(rows), static_cast<Eigen::Index>(columns));
    get_raw(matrix.data(), rows * columns * sizeof(S));
  }
  void get(Eigen::Quaterniond& q) { get(q.coeffs()); }

  std::string_view rest_;
};

}  // namespace flexneck
