// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "fe_modal/solve/iterative/preconditioned_inverse.h"
#include "fe_modal/solve/iterative/schwarz.h"
#include "fe_modal/system/assembly.h"
#include "fe_modal/system/rank_part.h"

namespace flexneck::fe_modal {

/// (K - shift M)^-1 by iteration, for bodies whose factor does not fit: no more than subdomains of
/// some ten thousand nodes are factorised.
class SchwarzInverse : public PreconditionedInverse {
 public:
  /// @param body, formulation of all elements
  /// @param prestress_m displacements whose stresses stiffen the body, on all nodes; perhaps none
  /// @param part, matrices of this rank's elements; must outlive this
  /// @param stiffness, mass of the body, for products; must outlive this
  SchwarzInverse(const CutBody& body, const FormulationChoice& formulation,
                 const Eigen::Matrix3Xd& prestress_m, const RankPart& part,
                 const SystemMatrices& matrices, Mat stiffness, Mat mass, double shift);

  Eigen::MatrixXd solve(const Eigen::MatrixXd& right_hand_sides) const override;
  std::optional<EigenPairs> iterate(Mat mass, Eigen::Index count) const override;
  std::string describe() const override;

 private:
  Eigen::MatrixXd apply(const Eigen::MatrixXd& residuals) const override;

  std::unique_ptr<const SchwarzPreconditioner> preconditioner_;
};

}  // namespace flexneck::fe_modal
