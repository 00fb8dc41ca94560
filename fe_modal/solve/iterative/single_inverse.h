// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "fe_modal/algebra/block_product.h"
#include "fe_modal/algebra/cholmod_order.h"
#include "fe_modal/algebra/supernodal_factor.h"
#include "fe_modal/solve/iterative/preconditioned_inverse.h"

namespace flexneck::fe_modal {

class CholmodAnalysis;

/// Of an entry on the diagonal: where elimination in single precision leaves less, its roundings of
/// 6e-8 may make much of the pivot.
inline constexpr double kDoubtfulSinglePivot = 1e-5;

/// A factor in single precision, which the BLAS makes in half the time of one in double; nothing
/// where its pivots are doubtful.
std::optional<SupernodalFactor<float>> factorise_in_single(CholmodAnalysis& analysis,
                                                           unsigned threads);

/// K and M of a body, for products; must outlive what is made with them.
struct Matrices {
  Mat stiffness;
  Mat mass;
};

struct SingleFactor {
  BlockOperator apply;  ///< (K - shift M)^-1 x, of numbers neither very large nor very small
  std::string text;     ///< what it has, for the user
};

/// (K - shift M)^-1 by a Cholesky factor in single precision and iteration: half the time and the
/// memory of one in double, for a few more solves. What it finds is as accurate, since its
/// residuals are computed in double precision. Modes are found by the block Davidson method and one
/// inverse iteration. Where an iteration does not settle, a factor in double takes over.
class SingleInverse : public PreconditionedInverse {
 public:
  /// Makes the other factor. Collective.
  using InDouble = std::function<std::unique_ptr<ShiftInverse>()>;

  SingleInverse(SingleFactor factor, const Matrices& matrices, double shift,
                InDouble make_in_double, const Ranks& ranks = {});

  Eigen::MatrixXd solve(const Eigen::MatrixXd& right_hand_sides) const override;
  Eigen::MatrixXd improve(const Eigen::MatrixXd& right_hand_sides,
                          const Eigen::MatrixXd& solutions) const override;
  Eigen::MatrixXd approximate(const Eigen::MatrixXd& right_hand_sides) const override {
    return apply(right_hand_sides);
  }
  std::optional<EigenPairs> iterate(Mat mass, Eigen::Index count) const override;
  bool is_doubtful() const override;
  std::string describe() const override;

 private:
  Eigen::MatrixXd apply(const Eigen::MatrixXd& residuals) const override;
  void go_on_in_double() const;

  mutable SingleFactor factor_;
  InDouble make_in_double_;
  mutable std::unique_ptr<ShiftInverse> in_double_;
};

/// In a process alone, in single precision or, where its pivots are doubtful, in double.
/// @param shifted_stiffness, node_order as those of CholeskyFactor
/// @param make_in_double for SingleInverse
/// @throws as CholeskyFactor.
std::unique_ptr<ShiftInverse> make_shift_inverse(Mat shifted_stiffness, const Matrices& matrices,
                                                 double shift, CholmodOrder kind,
                                                 std::span<const std::int32_t> node_order,
                                                 unsigned threads,
                                                 SingleInverse::InDouble make_in_double);

}  // namespace flexneck::fe_modal
