// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <string>
#include <type_traits>
#include <vector>

#include <mpi.h>

namespace flexneck::fe_modal {

using Bytes = std::vector<std::byte>;

/// Packs plain values, texts and lists of them, to be unpacked in the same order by ranks of the
/// same program.
class MessageWriter {
 public:
  template <typename Plain>
  void put(const Plain& value) {
    static_assert(std::is_trivially_copyable_v<Plain>);
    append(&value, sizeof(Plain));
  }
  void put(const std::string& text) { put_list(text); }
  template <typename Plain>
  void put(const std::vector<Plain>& list) {
    put_list(list);
  }

  const Bytes& bytes() const { return bytes_; }

 private:
  template <typename List>
  void put_list(const List& list) {
    static_assert(std::is_trivially_copyable_v<typename List::value_type>);
    put(list.size());
    append(list.data(), list.size() * sizeof(typename List::value_type));
  }
  void append(const void* values, std::size_t size) {
    const std::size_t end = bytes_.size();
    bytes_.resize(end + size);
    if (size > 0) std::memcpy(bytes_.data() + end, values, size);
  }

  Bytes bytes_;
};

class MessageReader {
 public:
  explicit MessageReader(Bytes bytes) : bytes_(std::move(bytes)) {}

  template <typename Plain>
  Plain get() {
    static_assert(std::is_trivially_copyable_v<Plain>);
    Plain value;
    take(&value, sizeof(Plain));
    return value;
  }
  std::string text() { return get_list<std::string>(); }
  template <typename Plain>
  std::vector<Plain> list() {
    return get_list<std::vector<Plain>>();
  }

 private:
  template <typename List>
  List get_list() {
    List result;
    result.resize(get<std::size_t>());
    take(result.data(), result.size() * sizeof(typename List::value_type));
    return result;
  }
  void take(void* values, std::size_t size) {
    if (size > 0) std::memcpy(values, bytes_.data() + next_, size);
    next_ += size;
  }

  Bytes bytes_;
  std::size_t next_ = 0;
};

/// @throws InputError if there are more bytes than MPI counts.
void send(MPI_Comm ranks, int to, const Bytes& bytes);
/// Waits without keeping the processor busy for long: the sender may have much else to do.
Bytes receive(MPI_Comm ranks, int from);

/// In a handler: what was thrown, in words.
std::string current_failure();

/// Runs `work` on every rank that calls this, and then all or none of them go on: what one of them
/// throws becomes a ComputationError of the same text on all. Collective.
void together(MPI_Comm ranks, const std::function<void()>& work);

}  // namespace flexneck::fe_modal
