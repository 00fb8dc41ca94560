// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/attached_mass.h"

#include <utility>

#include <Eigen/Geometry>

#include "fe_modal/block_lanczos.h"

namespace flexneck::fe_modal {
namespace {

constexpr const char* kAttaching = "attaching a rigid body";

}  // namespace

Matrix6d rigid_mass_matrix(double mass_kg, const Eigen::Vector3d& center_m,
                           const Eigen::Matrix3d& inertia_kg_m2) {
  Eigen::Matrix3d skew;
  skew << 0, -center_m.z(), center_m.y(), center_m.z(), 0, -center_m.x(), -center_m.y(),
      center_m.x(), 0;
  Matrix6d matrix;
  matrix << mass_kg * Eigen::Matrix3d::Identity(), -mass_kg * skew, mass_kg * skew,
      inertia_kg_m2 - mass_kg * skew * skew;
  return matrix;
}

struct AttachedMass::Terms {
  Mat mass;
  Matrix6d rigid_mass;
  Eigen::Matrix<double, 6, Eigen::Dynamic> average;  ///< C, (6, dofs)

  static PetscErrorCode multiply(Mat shell, Vec x, Vec y) {
    const Terms* terms = nullptr;
    PetscErrorCode code = MatShellGetContext(shell, static_cast<void*>(&terms));
    if (code == 0) code = MatMult(terms->mass, x, y);
    const PetscScalar* in = nullptr;
    PetscScalar* out = nullptr;
    if (code == 0) code = VecGetArrayRead(x, &in);
    if (code == 0) code = VecGetArray(y, &out);
    if (code != 0) return code;
    const Eigen::Index size = terms->average.cols();
    const Vector6d motion = terms->average * Eigen::Map<const Eigen::VectorXd>(in, size);
    Eigen::Map<Eigen::VectorXd>(out, size) +=
        terms->average.transpose() * (terms->rigid_mass * motion);
    code = VecRestoreArray(y, &out);
    return code != 0 ? code : VecRestoreArrayRead(x, &in);
  }
};

AttachedMass::AttachedMass(Mat mass, const FreeNodes& free_nodes, const RigidAverage& region,
                           const Matrix6d& rigid_mass) {
  auto terms = std::make_shared<Terms>();
  terms->mass = mass;
  terms->rigid_mass = rigid_mass;
  terms->average.resize(6, free_nodes.dof_count());
  const auto weights = region.weights(free_nodes.node_count());
  for (std::size_t i = 0; i < weights.size(); ++i) {
    terms->average.row(static_cast<Eigen::Index>(i)) = free_nodes.gather(weights[i]).transpose();
  }
  terms_ = terms;
  const auto size = static_cast<PetscInt>(free_nodes.dof_count());
  require(MatCreateShell(PETSC_COMM_SELF, size, size, size, size, terms.get(), shell_.out()),
          kAttaching);
  require(MatShellSetOperation(shell_.get(), MATOP_MULT,
                               reinterpret_cast<void (*)()>(&Terms::multiply)),
          kAttaching);
  require(MatSetOption(shell_.get(), MAT_SYMMETRIC, PETSC_TRUE), kAttaching);
}

Eigen::MatrixXd AttachedMass::loads() const { return terms_->average.transpose(); }

Eigen::VectorXd lowest_eigenvalues(const AttachedMass& mass, const ShiftInverse& inverse,
                                   const Eigen::MatrixXd& modes, Eigen::Index count) {
  // Its own method needs no exact solves, which are dear there and never quite exact.
  if (const auto own = inverse.iterate(mass.matrix(), count)) return own->values;
  // The error of an eigenvalue is the square of this, over the relative gap to the next.
  constexpr double kResidual = 1e-6;
  const Eigen::MatrixXd responses = inverse.solve(mass.loads());
  Eigen::MatrixXd start(modes.rows(), modes.cols() + responses.cols());
  start << modes, responses;
  start.colwise().normalize();
  const Settled settled = [](const RitzState& state) {
    return state.residuals.maxCoeff() < kResidual;
  };
  return block_lanczos(mass.matrix(), inverse, EigenPairs(), std::move(start), count, settled)
      .values;
}

}  // namespace flexneck::fe_modal
