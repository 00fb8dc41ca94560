// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/solve/iterative/schwarz_inverse.h"

#include <string>
#include <utility>

#include "geometry/foundation/error.h"
#include "geometry/foundation/output_file.h"

namespace flexneck::fe_modal {
namespace {

/// 1 for each element that has a marked block, 0 for others; marks all blocks of the former.
std::vector<std::int32_t> touching(const CutBody& body, std::vector<bool>& is_marked) {
  const std::vector<bool> before = is_marked;
  const DofMap& dof_map = body.fields.dof_map();
  std::vector<std::int32_t> touches;
  for_each_element(body.mesh, [&](std::size_t /*element*/, std::span<const std::int32_t> nodes) {
    bool does = false;
    for (const std::int32_t node : nodes) {
      dof_map.for_each_number(node, [&](std::int32_t block) {
        does = does || before[static_cast<std::size_t>(block)];
      });
    }
    touches.push_back(does ? 1 : 0);
    for (const std::int32_t node : does ? nodes : nodes.first(0)) {
      dof_map.for_each_number(
          node, [&](std::int32_t block) { is_marked[static_cast<std::size_t>(block)] = true; });
    }
  });
  return touches;
}

/// Elements so near to this rank's subdomains that the matrix is whole in the rows of their blocks
/// and of the blocks next to these.
std::vector<std::int32_t> elements_around(const CutBody& body) {
  std::vector<bool> is_marked(static_cast<std::size_t>(body.fields.dof_map().free_count()), false);
  for (std::size_t s = 0; s < body.subdomains.blocks.size(); ++s) {
    if (body.rank_of_subdomain[s] != body.fields.ranks().own()) continue;
    for (const std::int32_t block : body.subdomains.blocks[s]) {
      is_marked[static_cast<std::size_t>(block)] = true;
    }
  }
  touching(body, is_marked);
  return touching(body, is_marked);
}

/// Collective.
std::unique_ptr<const SchwarzPreconditioner> make_preconditioner(
    const CutBody& body, const FormulationChoice& formulation, const Eigen::Matrix3Xd& prestress_m,
    const RankPart& part, const SystemMatrices& matrices, double shift) {
  const Ranks& ranks = body.fields.ranks();
  std::optional<SymmetricMatrix> shifted;
  ranks.together([&] {
    if (shift != 0) shifted = shifted_stiffness(matrices, shift);
  });
  const PartMatrix own{shifted ? *shifted : matrices.stiffness, matrices.graph, part.blocks()};
  if (!ranks.are_many()) return std::make_unique<const SchwarzPreconditioner>(body, own, own);
  std::optional<RankPart> around;
  std::optional<NodeGraph> graph;
  std::optional<SymmetricMatrix> whole;
  ranks.together([&] {
    around.emplace(body.mesh, body.fields.dof_map(), elements_around(body), 1);
    SystemMatrices all = assemble(around->mesh(), around->dof_map(), formulation,
                                  around->columns_of_nodes(prestress_m));
    whole.emplace(shift != 0 ? shifted_stiffness(all, shift) : std::move(all.stiffness));
    graph.emplace(std::move(all.graph));
  });
  return std::make_unique<const SchwarzPreconditioner>(
      body, own, PartMatrix{*whole, *graph, around->blocks()});
}

}  // namespace

SchwarzInverse::SchwarzInverse(const CutBody& body, const FormulationChoice& formulation,
                               const Eigen::Matrix3Xd& prestress_m, const RankPart& part,
                               const SystemMatrices& matrices, Mat stiffness, Mat mass,
                               double shift)
    : PreconditionedInverse(stiffness, mass, shift, body.fields.ranks()),
      preconditioner_(make_preconditioner(body, formulation, prestress_m, part, matrices, shift)) {}

Eigen::MatrixXd SchwarzInverse::apply(const Eigen::MatrixXd& residuals) const {
  return preconditioner_->apply(residuals);
}

Eigen::MatrixXd SchwarzInverse::solve(const Eigen::MatrixXd& right_hand_sides) const {
  constexpr int kMaxIterations = 2000;
  return gradient_solution(right_hand_sides, kMaxIterations);
}

std::optional<EigenPairs> SchwarzInverse::iterate(Mat mass, Eigen::Index count) const {
  constexpr int kMaxIterations = 500;
  // Of eigenvalues; shapes are exact to its square root, 3e-8.
  constexpr double kTolerance = 1e-15;
  std::optional<EigenPairs> pairs = davidson_pairs(mass, count, {kTolerance, kMaxIterations});
  if (pairs) return pairs;
  throw ComputationError("the iterative eigensolver has not converged in " +
                         std::to_string(kMaxIterations) + " iterations");
}

std::string SchwarzInverse::describe() const {
  return "iterative" +
         (ranks().are_many() ? " on " + std::to_string(ranks().count()) + " ranks" : "") + ": " +
         std::to_string(preconditioner_->subdomain_count()) + " subdomains, whose factors have " +
         rounded_text(preconditioner_->nonzeros() / 1e6, 4) + " million entries, and " +
         std::to_string(preconditioner_->coarse_size()) + " coarse functions" + iterations_text();
}

}  // namespace flexneck::fe_modal
