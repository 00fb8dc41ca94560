// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

namespace flexneck::fe_modal {

/// Columns that are worked on together: as many numbers as the widest register holds.
inline constexpr std::size_t kColumnsTogether = 8;
/// The same in single precision, where there are as many columns.
inline constexpr std::size_t kSinglesTogether = 2 * kColumnsTogether;

/// A row of eight right-hand sides, or of a single one. A matrix or a factor, which no cache holds,
/// is read once for all of them.
template <typename Scalar, std::size_t lanes = kColumnsTogether>
struct alignas(lanes * sizeof(Scalar)) RowOf {
  Scalar value[lanes];
};

/// A row in vector registers of so many bytes. Wider ones than the processor has would be taken
/// apart number by number.
template <typename Number, std::size_t bytes, std::size_t lanes = kColumnsTogether>
struct RegisterRow {
  using Scalar = Number;
  static constexpr std::size_t kLanes = lanes;
  static constexpr std::size_t kBytes =
      bytes < kLanes * sizeof(Scalar) ? bytes : kLanes * sizeof(Scalar);
  static constexpr std::size_t kRegisters = kLanes * sizeof(Scalar) / kBytes;
  // An attribute, since no type of the standard is a register.
  typedef Scalar Register __attribute__((vector_size(kBytes), may_alias));

  Register part[kRegisters];  ///< not set: zeroing rows that are loaded would take time

  [[gnu::always_inline]] void load(const RowOf<Scalar, lanes>& row) {
    for (std::size_t k = 0; k < kRegisters; ++k) {
      part[k] = reinterpret_cast<const Register*>(row.value)[k];
    }
  }
  [[gnu::always_inline]] void store(RowOf<Scalar, lanes>& row) const {
    for (std::size_t k = 0; k < kRegisters; ++k) {
      reinterpret_cast<Register*>(row.value)[k] = part[k];
    }
  }
  [[gnu::always_inline]] void add(Scalar factor, const RegisterRow& other) {
    for (std::size_t k = 0; k < kRegisters; ++k) part[k] += factor * other.part[k];
  }
  [[gnu::always_inline]] void subtract(Scalar factor, const RegisterRow& other) {
    for (std::size_t k = 0; k < kRegisters; ++k) part[k] -= factor * other.part[k];
  }
  [[gnu::always_inline]] void multiply(Scalar factor) {
    for (std::size_t k = 0; k < kRegisters; ++k) part[k] *= factor;
  }
  [[gnu::always_inline]] void divide(Scalar divisor) {
    for (std::size_t k = 0; k < kRegisters; ++k) part[k] /= divisor;
  }
};

/// Adds rows to others, a stride from one to the next; inline in loops of run_with(), whose
/// registers it takes.
template <typename Scalar, std::size_t lanes>
[[gnu::always_inline]] inline void add_rows(const RowOf<Scalar, lanes>* from, std::size_t count,
                                            std::size_t stride, RowOf<Scalar, lanes>* to) {
  for (std::size_t k = 0; k < count; ++k) {
    RowOf<Scalar, lanes>& sum = to[stride * k];
    for (std::size_t c = 0; c < lanes; ++c) sum.value[c] += from[k].value[c];
  }
}

/// A row of one.
struct SingleRow {
  static constexpr std::size_t kLanes = 1;
  using Scalar = double;

  double number = 0;

  void load(const RowOf<double, 1>& row) { number = row.value[0]; }
  void store(RowOf<double, 1>& row) const { row.value[0] = number; }
  void add(double factor, const SingleRow& other) { number += factor * other.number; }
  void subtract(double factor, const SingleRow& other) { number -= factor * other.number; }
};

enum class VectorRegisters { of_16_bytes, of_32_bytes, of_64_bytes };

/// The widest that this processor has.
inline VectorRegisters widest_registers() {
#ifdef __x86_64__
  static const VectorRegisters widest = [] {
    if (__builtin_cpu_supports("avx512f")) return VectorRegisters::of_64_bytes;
    return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")
               ? VectorRegisters::of_32_bytes
               : VectorRegisters::of_16_bytes;
  }();
  return widest;
#else
  return VectorRegisters::of_16_bytes;
#endif
}

#ifdef __x86_64__
template <typename Loops>
[[gnu::target("avx2,fma")]] void run_with_32_bytes(const Loops& loops) {
  loops.template operator()<32>();
}
template <typename Loops>
[[gnu::target("avx512f,avx2,fma")]] void run_with_64_bytes(const Loops& loops) {
  loops.template operator()<64>();
}
#endif

/// Runs loops, compiled for each width, with the registers given.
/// @param loops [&]<std::size_t bytes>() __attribute__((always_inline)) {…}: what it calls must be
///     inline to be compiled so too.
template <typename Loops>
void run_with([[maybe_unused]] VectorRegisters registers, const Loops& loops) {
#ifdef __x86_64__
  if (registers == VectorRegisters::of_64_bytes) return run_with_64_bytes(loops);
  if (registers == VectorRegisters::of_32_bytes) return run_with_32_bytes(loops);
#endif
  loops.template operator()<16>();
}

}  // namespace flexneck::fe_modal
