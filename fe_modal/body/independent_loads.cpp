// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/body/independent_loads.h"

#include "geometry/foundation/symmetric_pairs.h"

namespace flexneck::fe_modal {
namespace {

/// Fraction of the static energy below which a shape is rounding. A basis without it has all but
/// this fraction of the compliance.
constexpr double kNoEnergy = 1e-10;

}  // namespace

IndependentLoads independent_loads(const Eigen::MatrixXd& rest, const Eigen::VectorXd& whole) {
  const Eigen::VectorXd scale =
      (whole.array() > 0).select(whole.array().max(0).sqrt().inverse(), 0).matrix();
  const Eigen::MatrixXd shares =
      scale.asDiagonal() * ((rest + rest.transpose()) / 2) * scale.asDiagonal();
  const auto [energies, vectors] = symmetric_pairs(shares);
  const Eigen::Index dropped = (energies.array() < kNoEnergy).count();
  const Eigen::Index kept = energies.size() - dropped;
  return {scale.asDiagonal() * vectors.rightCols(kept) *
              energies.tail(kept).cwiseSqrt().cwiseInverse().asDiagonal(),
          dropped};
}

}  // namespace flexneck::fe_modal
