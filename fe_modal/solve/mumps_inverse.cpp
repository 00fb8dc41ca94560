// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/solve/mumps_inverse.h"

#include <array>
#include <cstdio>

namespace flexneck::fe_modal {

MumpsInverse::MumpsInverse(const DofLayout& layout, SystemMatrices& matrices, double shift,
                           std::span<const std::int32_t> blocks,
                           std::span<const std::int32_t> order)
    : ShiftInverse(shift, layout.ranks()) {
  std::optional<SymmetricMatrix> shifted;
  layout.ranks().together([&] {
    if (shift != 0) shifted = shifted_stiffness(matrices, shift);
  });
  factor_.emplace(layout, MumpsFactor::Kind::definite, shifted ? *shifted : matrices.stiffness,
                  blocks, order);
}

std::string MumpsInverse::describe() const {
  std::array<char, 80> text{};
  std::snprintf(text.data(), text.size(), "the factor has %.4g million entries on %d ranks",
                factor_->nonzeros() / 1e6, ranks().count());
  return text.data();
}

}  // namespace flexneck::fe_modal
