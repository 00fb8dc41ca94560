// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/drawing/colours.h"

#include <algorithm>
#include <array>

namespace flexneck::mesher {
namespace {

Colour from_hex(std::uint32_t rgb) {
  return {static_cast<float>(rgb >> 16U) / 255, static_cast<float>(rgb >> 8U & 0xFFU) / 255,
          static_cast<float>(rgb & 0xFFU) / 255};
}

}  // namespace

Colour scale_colour(double share) {
  const double place = std::clamp(share, 0.0, 1.0) * (kColourScale.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(place), kColourScale.size() - 2);
  const auto rest = static_cast<float>(place - static_cast<double>(below));
  return (1 - rest) * from_hex(kColourScale[below]) + rest * from_hex(kColourScale[below + 1]);
}

Colour category_colour(std::size_t index) {
  static constexpr std::array<std::uint32_t, 8> kColours = {0xB9C4CE, 0x666B75, 0x5B8DB8, 0xD9A441,
                                                            0x7FB285, 0xB5657A, 0x8C7AB8, 0xE3D5B0};
  return from_hex(kColours[index % kColours.size()]);
}

}  // namespace flexneck::mesher
