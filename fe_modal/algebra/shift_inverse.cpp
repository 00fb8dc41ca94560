// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/algebra/shift_inverse.h"

namespace flexneck::fe_modal {

void solve(const ShiftInverse& inverse, Vec right_hand_side, Vec solution) {
  constexpr const char* kReading = "reading a vector of the eigensolver";
  PetscInt size = 0;
  const PetscScalar* in = nullptr;
  PetscScalar* out = nullptr;
  require(VecGetLocalSize(right_hand_side, &size), kReading);
  require(VecGetArrayRead(right_hand_side, &in), kReading);
  require(VecGetArray(solution, &out), kReading);
  Eigen::Map<Eigen::MatrixXd>(out, size, 1) =
      inverse.solve(Eigen::Map<const Eigen::MatrixXd>(in, size, 1));
  require(VecRestoreArray(solution, &out), kReading);
  require(VecRestoreArrayRead(right_hand_side, &in), kReading);
}

}  // namespace flexneck::fe_modal
