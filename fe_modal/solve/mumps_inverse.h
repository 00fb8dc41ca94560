// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "fe_modal/algebra/mumps_factor.h"
#include "fe_modal/algebra/shift_inverse.h"
#include "fe_modal/system/assembly.h"

namespace flexneck::fe_modal {

/// (K - shift M)^-1 by a factor on all ranks.
class MumpsInverse : public ShiftInverse {
 public:
  /// @param matrices of this rank's part of the body
  /// @param blocks, order as MumpsFactor takes them
  MumpsInverse(const DofLayout& layout, SystemMatrices& matrices, double shift,
               std::span<const std::int32_t> blocks, std::span<const std::int32_t> order);

  Eigen::MatrixXd solve(const Eigen::MatrixXd& right_hand_sides) const override {
    return factor_->solve(right_hand_sides);
  }
  std::string describe() const override;

 private:
  std::optional<MumpsFactor> factor_;
};

}  // namespace flexneck::fe_modal
