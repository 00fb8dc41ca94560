// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/algebra/cholesky_factor.h"

#include <array>
#include <cstdio>
#include <vector>

#include "fe_modal/algebra/cholmod_handles.h"
#include "fe_modal/algebra/supernodes.h"
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
  Supernodes supernodes;
};

CholeskyFactor::CholeskyFactor(Mat shifted_stiffness, double shift,
                               std::span<const std::int32_t> node_order, unsigned threads)
    : ShiftInverse(shift),
      threads_(threads),
      handles_(std::make_unique<Handles>(node_order.empty() ? CholmodOrder::best
                                                            : CholmodOrder::given)) {
  make(shifted_stiffness, order_of_dofs(node_order));
}

CholeskyFactor::CholeskyFactor(Mat shifted_stiffness, double shift, AsNumbered, unsigned threads)
    : ShiftInverse(shift),
      threads_(threads),
      handles_(std::make_unique<Handles>(CholmodOrder::numbering)) {
  make(shifted_stiffness, {});
}

CholeskyFactor::~CholeskyFactor() = default;

void CholeskyFactor::make(Mat shifted_stiffness, std::span<const int> dof_order) {
  auto& [session, factor, supernodes] = *handles_;
  const cholmod_sparse view = view_of(shifted_stiffness);
  factor = analyse(view, dof_order, session);
  nonzeros_ = session.get()->lnz;
  require_memory("the factor of " + millions_text(nonzeros_), kBytesPerFactorEntry * nonzeros_,
                 kOrAnotherSolution);
  factorise(view, factor, session);
  supernodes = Supernodes(*factor);
}

Eigen::MatrixXd CholeskyFactor::solve(const Eigen::MatrixXd& right_hand_sides) const {
  const Supernodes& supernodes = handles_->supernodes;
  Eigen::MatrixXd x = right_hand_sides(supernodes.order(), Eigen::all);
  supernodes.solve(values_of(*handles_->factor), x, threads_);
  Eigen::MatrixXd solutions(x.rows(), x.cols());
  solutions(supernodes.order(), Eigen::all) = x;
  return solutions;
}

std::string CholeskyFactor::describe() const {
  return "the factor has " + millions_text(nonzeros_);
}

}  // namespace flexneck::fe_modal
