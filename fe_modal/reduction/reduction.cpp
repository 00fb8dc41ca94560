// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/reduction/reduction.h"

#include <memory>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include "fe_modal/algebra/matrix_product.h"
#include "fe_modal/algebra/operator_matrix.h"
#include "fe_modal/reduction/ritz.h"
#include "fe_modal/reduction/static_shapes.h"
#include "geometry/foundation/error.h"

namespace flexneck::fe_modal {

namespace {

/// Operator P^T M P, with P the K-orthogonal projector to the fields on which C x = 0: P = I - X (C
/// X)^-1 C with K X = C^T. The eigenpairs of K x = lambda P^T M P x with finite lambda are the
/// modes of the body whose interfaces' average motions C x are fixed: K^-1 P^T = P K^-1 is
/// symmetric, so that x = lambda P K^-1 M P x has C x = 0.
class ConstrainedMass {
 public:
  /// @param mass mass matrix of the free degrees of freedom; must outlive this
  /// @param constraints C^T, (dofs, n), independent
  /// @param responses X, (dofs, n)
  ConstrainedMass(const Ranks& ranks, Mat mass, const Eigen::MatrixXd& constraints,
                  const Eigen::MatrixXd& responses);

  Mat matrix() const { return operator_.get(); }
  /// Projection P x of each column.
  Eigen::MatrixXd project(const Eigen::MatrixXd& columns) const;

 private:
  struct Terms;
  std::shared_ptr<const Terms> terms_;
  OperatorMatrix operator_;
};

struct ConstrainedMass::Terms {
  Ranks ranks;
  Eigen::MatrixXd constraints;           ///< C^T, (dofs, n)
  Eigen::MatrixXd responses;             ///< X, (dofs, n)
  Eigen::LLT<Eigen::MatrixXd> products;  ///< factor of C X

  Eigen::MatrixXd project(const Eigen::MatrixXd& fields) const {
    return fields - responses * products.solve(inner_products(ranks, constraints, fields));
  }
  Eigen::MatrixXd project_transposed(const Eigen::MatrixXd& momenta) const {
    return momenta - constraints * products.solve(inner_products(ranks, responses, momenta));
  }
};

Eigen::MatrixXd symmetric_part(const Eigen::MatrixXd& matrix) {
  return (matrix + matrix.transpose()) / 2;
}

ConstrainedMass::ConstrainedMass(const Ranks& ranks, Mat mass, const Eigen::MatrixXd& constraints,
                                 const Eigen::MatrixXd& responses)
    : terms_(std::make_shared<const Terms>(
          Terms{ranks, constraints, responses,
                Eigen::LLT<Eigen::MatrixXd>(
                    symmetric_part(inner_products(ranks, constraints, responses)))})),
      operator_(
          constraints.rows(),
          [mass, terms = terms_](const Eigen::MatrixXd& fields) {
            return terms->project_transposed(block_product(mass, terms->project(fields)));
          },
          ranks) {}

Eigen::MatrixXd ConstrainedMass::project(const Eigen::MatrixXd& columns) const {
  return terms_->project(columns);
}

EigenPairs joined(const EigenPairs& lower, const EigenPairs& upper) {
  EigenPairs all{Eigen::VectorXd(lower.values.size() + upper.values.size()),
                 Eigen::MatrixXd(lower.vectors.rows(), lower.values.size() + upper.values.size())};
  all.values << lower.values, upper.values;
  all.vectors << lower.vectors, upper.vectors;
  return all;
}

}  // namespace

Reduction complete_modes(const BodyOperators& body, const EigenPairs& normal,
                         const std::vector<InterfaceLoads>& interfaces, BasisKind kind,
                         Eigen::Index rigid_count, const Progress& progress) {
  Reduction reduction;
  reduction.pairs = normal;
  for (const double value : normal.values) {
    reduction.kinds.emplace_back(value > 0 ? kNormalMode : kRigidMode);
  }
  const bool free = body.shift != 0;
  const bool all_rigid_motions = (normal.values.array() == 0).count() >= rigid_count;
  if (kind != BasisKind::normal && free && !all_rigid_motions) {
    throw InputError("inertia relief needs all rigid-body modes of the body; request " +
                     std::to_string(rigid_count) + " modes or more");
  }
  if (interfaces.empty() || (free && !all_rigid_motions)) return reduction;

  const StaticShapes shapes = static_shapes(body, normal, interfaces);
  reduction.responses = shapes.responses;
  if (kind == BasisKind::normal) return reduction;
  const Eigen::MatrixXd combinations = correcting_loads(shapes, interfaces, progress);
  const EigenPairs corrections = ritz_pairs(body, normal.vectors, shapes.beyond * combinations);
  reduction.pairs = joined(normal, corrections);
  reduction.kinds.insert(reduction.kinds.end(), static_cast<std::size_t>(corrections.values.size()),
                         std::string(free ? kReliefMode : kResidualMode));
  return reduction;
}

Reduction craig_bampton(const BodyOperators& body, Mat mass, const ModeSolver& solve_modes,
                        Eigen::Index count, const std::vector<InterfaceLoads>& interfaces,
                        const Progress& progress) {
  const StaticShapes shapes = static_shapes(body, {}, interfaces);
  const Eigen::MatrixXd combinations = correcting_loads(shapes, interfaces, progress);
  const Eigen::MatrixXd responses = shapes.beyond * combinations;
  const ConstrainedMass constrained(body.ranks, mass, shapes.loads * combinations, responses);
  Eigen::MatrixXd vectors(responses.rows(), count + responses.cols());
  vectors.rightCols(responses.cols()) = responses;
  if (count > 0) {
    vectors.leftCols(count) = constrained.project(solve_modes(constrained.matrix(), count).vectors);
  }

  Reduction reduction;
  reduction.pairs = ritz_pairs(body, Eigen::MatrixXd(), std::move(vectors));
  reduction.kinds.assign(static_cast<std::size_t>(count), std::string(kRitzMode));
  reduction.kinds.insert(reduction.kinds.end(), static_cast<std::size_t>(responses.cols()),
                         std::string(kConstraintMode));
  reduction.responses = shapes.responses;
  return reduction;
}

}  // namespace flexneck::fe_modal
