// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/element/pressure_basis.h"

#include <Eigen/Cholesky>

namespace flexneck::fe_modal {

Eigen::Index pressure_count(PressureSpace space) {
  switch (space) {
    case PressureSpace::none:
      return 0;
    case PressureSpace::constant:
      return 1;
    case PressureSpace::along_axis:
      return 2;
    case PressureSpace::linear:
      return 4;
  }
  return 0;
}

void find_pressures(PressureSpace space, const Eigen::VectorXd& roots,
                    const Eigen::Matrix3Xd& reference, Eigen::MatrixX3d& positions,
                    Eigen::MatrixXd& pressures) {
  pressures.col(0) = roots;
  if (space == PressureSpace::along_axis) {
    pressures.col(1) = roots.cwiseProduct(reference.row(2).transpose());
  }
  if (space == PressureSpace::linear) {
    // Positions are centred and scaled for a well-conditioned Gram matrix; the span is the same.
    positions.rowwise() -= positions.colwise().mean().eval();
    const double size = positions.cwiseAbs().maxCoeff();
    pressures.rightCols<3>() = (roots / size).asDiagonal() * positions;
  }
  const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 4, 4> gram =
      pressures.transpose() * pressures;
  gram.llt().matrixL().transpose().solveInPlace<Eigen::OnTheRight>(pressures);
}

}  // namespace flexneck::fe_modal
