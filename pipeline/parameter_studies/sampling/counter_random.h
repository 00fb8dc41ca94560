// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

namespace flexneck::pipeline {

// Random numbers that depend only on the seed and their purpose, so that a row of a table is the
// same whoever computes it and in whatever order.

/// The finaliser of SplitMix64 (Steele, Lea and Flood 2014): each bit depends on all bits.
constexpr std::uint64_t mixed(std::uint64_t bits) {
  bits += 0x9e3779b97f4a7c15ULL;
  bits = (bits ^ (bits >> 30U)) * 0xbf58476d1ce4e5b9ULL;
  bits = (bits ^ (bits >> 27U)) * 0x94d049bb133111ebULL;
  return bits ^ (bits >> 31U);
}

/// 64 random bits.
/// @param stream  purpose of the bits, such as a dimension
constexpr std::uint64_t random_bits(std::uint64_t seed, std::uint64_t stream, std::uint64_t index) {
  return mixed(mixed(mixed(seed) ^ stream) ^ index);
}

/// A number in the open interval (0, 1): the middle of one of its 2^52 parts.
constexpr double open_unit(std::uint64_t bits) {
  return (static_cast<double>(bits >> 12U) + 0.5) * 0x1p-52;
}

/// Place of `index` in a random order of 0 … count - 1, in constant memory: Kensler (2013),
/// Correlated Multi-Jittered Sampling, listing 2, with one more step where count is 1.
/// @pre index < count <= 2^31
constexpr std::uint32_t permuted(std::uint32_t index, std::uint32_t count, std::uint32_t key) {
  std::uint32_t mask = count - 1;
  for (unsigned shift = 1; shift < 32; shift *= 2) mask |= mask >> shift;
  do {
    index ^= key;
    index *= 0xe170893dU;
    index ^= key >> 16U;
    index ^= (index & mask) >> 4U;
    index ^= key >> 8U;
    index *= 0x0929eb3fU;
    index ^= key >> 23U;
    index ^= (index & mask) >> 1U;
    index *= 1U | key >> 27U;
    index *= 0x6935fa69U;
    index ^= (index & mask) >> 11U;
    index *= 0x74dcb303U;
    index ^= (index & mask) >> 2U;
    index *= 0x9e501cc3U;
    index ^= (index & mask) >> 2U;
    index *= 0xc860a3dfU;
    index &= mask;
    index ^= index >> 5U;
  } while (index >= count);
  return static_cast<std::uint32_t>((std::uint64_t{index} + key) % count);
}

}  // namespace flexneck::pipeline
