// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/algebra/cholesky_factor.h"

#include <array>
#include <cstdio>
#include <vector>

#include "fe_modal/algebra/cholmod_handles.h"
#include "geometry/foundation/available_memory.h"
#include "geometry/foundation/error.h"

namespace flexneck::fe_modal {
namespace {

constexpr const char* kReading = "reading the stiffness matrix";

/// The matrix must outlive it.
cholmod_sparse view_of(Mat matrix) {
  PetscInt size = 0;
  const PetscInt* offsets = nullptr;
  const PetscInt* columns = nullptr;
  PetscScalar* values = nullptr;
  PetscBool done = PETSC_FALSE;
  require(MatGetRowIJ(matrix, 0, PETSC_FALSE, PETSC_TRUE, &size, &offsets, &columns, &done),
          kReading);
  require(MatSeqSBAIJGetArray(matrix, &values), kReading);
  const auto rows = static_cast<std::size_t>(size);
  const auto entries = static_cast<std::size_t>(offsets[rows]);
  return cholmod_view({offsets, rows + 1}, {columns, entries}, {values, entries});
}

cholmod_dense view_of(const Eigen::MatrixXd& columns) {
  cholmod_dense view{};
  view.nrow = view.d = static_cast<std::size_t>(columns.rows());
  view.ncol = static_cast<std::size_t>(columns.cols());
  view.nzmax = static_cast<std::size_t>(columns.size());
  view.x = const_cast<double*>(columns.data());
  view.xtype = CHOLMOD_REAL;
  view.dtype = CHOLMOD_DOUBLE;
  return view;
}

std::string millions_text(double entries) {
  std::array<char, 80> text{};
  std::snprintf(text.data(), text.size(), "%.4g million entries", entries / 1e6);
  return text.data();
}

}  // namespace

struct CholeskyFactor::Handles {
  explicit Handles(CholmodOrder order) : session(order), factor(nullptr, {&session}) {}

  CholmodSession session;
  CholmodFactor factor;
};

CholeskyFactor::CholeskyFactor(Mat shifted_stiffness, double shift,
                               std::span<const std::int32_t> node_order)
    : ShiftInverse(shift),
      handles_(std::make_unique<Handles>(node_order.empty() ? CholmodOrder::best
                                                            : CholmodOrder::given)) {
  make(shifted_stiffness, order_of_dofs(node_order));
}

CholeskyFactor::CholeskyFactor(Mat shifted_stiffness, double shift, AsNumbered)
    : ShiftInverse(shift), handles_(std::make_unique<Handles>(CholmodOrder::numbering)) {
  make(shifted_stiffness, {});
}

CholeskyFactor::~CholeskyFactor() = default;

void CholeskyFactor::make(Mat shifted_stiffness, std::span<const int> dof_order) {
  auto& [session, factor] = *handles_;
  const cholmod_sparse view = view_of(shifted_stiffness);
  factor = analyse(view, dof_order, session);
  nonzeros_ = session.get()->lnz;
  require_memory("the factor of " + millions_text(nonzeros_), kBytesPerFactorEntry * nonzeros_,
                 kOrAnotherSolution);
  factorise(view, factor, session);
}

Eigen::MatrixXd CholeskyFactor::solve(const Eigen::MatrixXd& right_hand_sides) const {
  Eigen::MatrixXd solutions(right_hand_sides.rows(), right_hand_sides.cols());
  if (solutions.size() == 0) return solutions;
  cholmod_common* const session = handles_->session.get();
  cholmod_dense in = view_of(right_hand_sides);
  cholmod_dense out = view_of(solutions);
  cholmod_dense* found = &out;
  cholmod_dense* permuted = nullptr;
  cholmod_dense* block = nullptr;
  cholmod_solve2(CHOLMOD_A, handles_->factor.get(), &in, nullptr, &found, nullptr, &permuted,
                 &block, session);
  cholmod_free_dense(&permuted, session);
  cholmod_free_dense(&block, session);
  if (session->status < 0) throw ComputationError("memory runs out while solving with the factor");
  return solutions;
}

std::string CholeskyFactor::describe() const {
  return "the factor has " + millions_text(nonzeros_);
}

}  // namespace flexneck::fe_modal
