// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/solve/iterative/iterative_system.h"

#include <array>
#include <cstdio>
#include <optional>
#include <string>

#include "fe_modal/algebra/block_product.h"
#include "fe_modal/algebra/conjugate_gradients.h"
#include "fe_modal/solve/iterative/block_davidson.h"
#include "fe_modal/solve/iterative/schwarz.h"
#include "geometry/foundation/error.h"

namespace flexneck::fe_modal {
namespace {

constexpr const char* kSolving = "solving by iteration";

}  // namespace

class IterativeSystem::Inverse : public ShiftInverse {
 public:
  Inverse(const SystemMatrices& system, double shift, const NodeLists& subdomains,
          const Eigen::Matrix3Xd& positions_m)
      : ShiftInverse(shift),
        shifted_(shift == 0 ? std::nullopt : std::optional(shifted_stiffness(system, shift))),
        matrix_(shifted_ ? *shifted_ : system.stiffness),
        preconditioner_(matrix_, system.graph, subdomains, positions_m) {}

  void solve(Vec right_hand_side, Vec solution) const override {
    const PetscScalar* in = nullptr;
    PetscScalar* out = nullptr;
    require(VecGetArrayRead(right_hand_side, &in), kSolving);
    require(VecGetArray(solution, &out), kSolving);
    Eigen::Map<Eigen::MatrixXd>(out, matrix_.size(), 1) =
        solve(Eigen::Map<const Eigen::MatrixXd>(in, matrix_.size(), 1));
    require(VecRestoreArray(solution, &out), kSolving);
    require(VecRestoreArrayRead(right_hand_side, &in), kSolving);
  }

  Eigen::MatrixXd solve(const Eigen::MatrixXd& right_hand_sides) const override {
    return conjugate_gradients([&](const Eigen::MatrixXd& x) { return block_product(matrix_, x); },
                               [&](const Eigen::MatrixXd& r) { return precondition(r); },
                               right_hand_sides);
  }

  Eigen::MatrixXd precondition(const Eigen::MatrixXd& residuals) const override {
    ++gradient_iterations_;
    return preconditioner_.apply(residuals);
  }

  std::optional<EigenPairs> iterate(Mat mass, Eigen::Index count) const override {
    DavidsonResult result = block_davidson(
        [&](const Eigen::MatrixXd& x) { return block_product(matrix_, x); },
        [&](const Eigen::MatrixXd& x) { return block_product(mass, x); },
        [&](const Eigen::MatrixXd& r) { return preconditioner_.apply(r); }, matrix_.size(), count);
    davidson_iterations_ += result.iterations;
    result.pairs.values.array() += shift();
    result.pairs.next += shift();
    return std::move(result.pairs);
  }

  std::string describe() const override {
    std::array<char, 160> text{};
    std::snprintf(
        text.data(), text.size(),
        "iterative: %zu subdomains, whose factors have %.4g million entries, and %td coarse "
        "functions; %d block Davidson and %d conjugate gradient iterations",
        preconditioner_.subdomain_count(), preconditioner_.nonzeros() / 1e6,
        preconditioner_.coarse_size(), davidson_iterations_, gradient_iterations_);
    return text.data();
  }

 private:
  std::optional<SymmetricMatrix> shifted_;  ///< without a shift the stiffness itself serves
  const SymmetricMatrix& matrix_;
  SchwarzPreconditioner preconditioner_;
  mutable int davidson_iterations_ = 0;
  mutable int gradient_iterations_ = 0;
};

std::unique_ptr<ShiftInverse> IterativeSystem::shift_inverse(double shift) const {
  return std::make_unique<Inverse>(matrices(), shift, find_subdomains(mesh_, dof_map_),
                                   free_positions(mesh_, dof_map_));
}

Eigen::Index IterativeSystem::eigenvalues_below(double) const {
  throw InputError(
      "counting modes by inertia takes a factorisation, which the iterative solver does without: "
      "use the direct solver, or no certificate");
}

}  // namespace flexneck::fe_modal
