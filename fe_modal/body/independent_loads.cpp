// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/body/independent_loads.h"

#include <Eigen/Eigenvalues>

namespace flexneck::fe_modal {
namespace {

/// Share of the static energy below which a shape is rounding. A basis without it has all but this
/// share of the compliance.
constexpr double kNoEnergy = 1e-10;

}  // namespace

IndependentLoads independent_loads(const Eigen::MatrixXd& rest, const Eigen::VectorXd& whole) {
  const Eigen::VectorXd scale =
      (whole.array() > 0).select(whole.array().max(0).sqrt().inverse(), 0).matrix();
  const Eigen::MatrixXd shares =
      scale.asDiagonal() * ((rest + rest.transpose()) / 2) * scale.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(shares);
  const Eigen::VectorXd& energies = solver.eigenvalues();  // ascending
  const Eigen::Index dropped = (energies.array() < kNoEnergy).count();
  const Eigen::Index kept = energies.size() - dropped;
  return {scale.asDiagonal() * solver.eigenvectors().rightCols(kept) *
              energies.tail(kept).cwiseSqrt().cwiseInverse().asDiagonal(),
          dropped};
}

}  // namespace flexneck::fe_modal
