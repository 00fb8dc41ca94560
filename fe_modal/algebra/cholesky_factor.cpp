// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/algebra/cholesky_factor.h"

#include <array>
#include <cstdio>
#include <vector>

#include "geometry/foundation/available_memory.h"
#include "geometry/foundation/error.h"

namespace flexneck::fe_modal {
namespace {

constexpr const char* kFactorising = "factorising the stiffness matrix";
constexpr const char* kOtherwise =
    "take a coarser mesh, --solver iterative, or more ranks with mpirun";

/// The order of nodes as one of degrees of freedom.
IsHandle expand_order(std::span<const std::int32_t> node_order) {
  std::vector<PetscInt> dofs;
  dofs.reserve(3 * node_order.size());
  for (const std::int32_t node : node_order) {
    for (PetscInt a = 0; a < 3; ++a) dofs.push_back(3 * node + a);
  }
  IsHandle order;
  require(ISCreateGeneral(PETSC_COMM_SELF, static_cast<PetscInt>(dofs.size()), dofs.data(),
                          PETSC_COPY_VALUES, order.out()),
          kFactorising);
  require(ISSetPermutation(order.get()), kFactorising);
  return order;
}

std::string millions_text(double entries) {
  std::array<char, 80> text{};
  std::snprintf(text.data(), text.size(), "%.4g million entries", entries / 1e6);
  return text.data();
}

}  // namespace

CholeskyFactor::CholeskyFactor(Mat shifted_stiffness, double shift,
                               std::span<const std::int32_t> node_order)
    : ShiftInverse(shift) {
  const bool given = !node_order.empty();
  require(MatSetOptionsPrefixFactor(shifted_stiffness, given ? kGivenOrderPrefix : nullptr),
          kFactorising);
  require(MatGetFactor(shifted_stiffness, MATSOLVERCHOLMOD, MAT_FACTOR_CHOLESKY, factor_.out()),
          kFactorising);
  const IsHandle order = given ? expand_order(node_order) : IsHandle();
  MatFactorInfo settings;
  require(MatFactorInfoInitialize(&settings), kFactorising);
  require(MatCholeskyFactorSymbolic(factor_.get(), shifted_stiffness, order.get(), &settings),
          kFactorising);
  MatInfo info;
  require(MatGetInfo(factor_.get(), MAT_LOCAL, &info), kFactorising);
  nonzeros_ = info.nz_used;
  require_memory("the factor of " + millions_text(nonzeros_), kBytesPerFactorEntry * nonzeros_,
                 kOtherwise);
  const PetscErrorCode code = MatCholeskyFactorNumeric(factor_.get(), shifted_stiffness, &settings);
  if (code != PETSC_ERR_MAT_CH_ZRPVT) require(code, kFactorising);
  MatFactorError error = MAT_FACTOR_NOERROR;
  require(MatFactorGetError(factor_.get(), &error), kFactorising);
  if (code != 0 || error != MAT_FACTOR_NOERROR) {
    throw ComputationError(kNotDefinite);
  }
}

Eigen::MatrixXd CholeskyFactor::solve(const Eigen::MatrixXd& right_hand_sides) const {
  constexpr const char* kSolving = "solving with the factor";
  Eigen::MatrixXd solutions(right_hand_sides.rows(), right_hand_sides.cols());
  const auto rows = static_cast<PetscInt>(right_hand_sides.rows());
  const auto columns = static_cast<PetscInt>(right_hand_sides.cols());
  MatHandle in;
  MatHandle out;
  // PETSc takes memory that is not const; it only reads this.
  require(MatCreateSeqDense(PETSC_COMM_SELF, rows, columns,
                            const_cast<double*>(right_hand_sides.data()), in.out()),
          kSolving);
  require(MatCreateSeqDense(PETSC_COMM_SELF, rows, columns, solutions.data(), out.out()), kSolving);
  require(MatMatSolve(factor_.get(), in.get(), out.get()), kSolving);
  return solutions;
}

std::string CholeskyFactor::describe() const {
  return "the factor has " + millions_text(nonzeros_);
}

}  // namespace flexneck::fe_modal
