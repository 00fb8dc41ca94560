// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/solve/refined/refined_system.h"

#include <algorithm>
#include <utility>

namespace flexneck::fe_modal {
namespace {

/// A star moves less than it would if what is around it did not rest. With twice its solution the
/// modes of rubber parts take a step less, and of the meshes of certificate_benchmark none takes
/// more than one step more (calibrated).
constexpr double kStarWeight = 2;
/// Corrections by the mesh before bring divergences along. Where nothing within its elements takes
/// these away the stars must, and count for more. With this weight meshes of 20-node hexahedra and
/// ten-node tetrahedra take half the steps that they take with the other one (calibrated).
constexpr double kStarWeightAlone = 16;
/// Elements without pressures of their own see all of these divergences, so that hardly anything of
/// the corrections is left where rubber is nearly incompressible. 20-node hexahedra with reduced
/// integration take a third of the steps (calibrated: 55 608 degrees of freedom take as many with
/// 400 and 30 000, 174 720 more).
constexpr double kStarWeightWithoutPressures = 3000;

double find_star_weight(const mesher::Mesh& mesh, const FormulationChoice& formulation) {
  double weight = kStarWeightWithoutPressures;
  for (const mesher::ElementBlock& block : mesh.blocks) {
    const Formulation own = formulation.of(mesh.materials.at(block.material));
    if (element_scheme(block.kind, own).pressures != PressureSpace::none) weight = kStarWeightAlone;
  }
  return weight;
}

/// Of the elements, springs and masses of the refined mesh; empty in a process alone.
std::vector<std::int32_t> ranks_of_pieces(const AssembledSystem& coarse,
                                          const mesher::RefinedMesh& refined) {
  std::vector<std::int32_t> ranks;
  if (!coarse.ranks().are_many()) return ranks;
  for (const std::int32_t parent : refined.parents) {
    ranks.push_back(coarse.rank_of_element()[static_cast<std::size_t>(parent)]);
  }
  ranks.resize(element_count(refined.mesh), 0);
  return ranks;
}

RankPart own_part(const Ranks& ranks, const mesher::Mesh& mesh, const DofMap& dof_map,
                  const std::vector<std::int32_t>& rank_of_element) {
  if (!ranks.are_many()) return {mesh, dof_map};
  return {mesh, dof_map, rank_of_element, ranks.own()};
}

/// Nodes of whose elements the lowest rank is this one. Springs and masses do not count: all stars
/// within one parent must be of the rank that has it, which takes the largest.
std::vector<bool> own_nodes(const Ranks& ranks, const mesher::RefinedMesh& refined,
                            const std::vector<std::int32_t>& rank_of_element) {
  std::vector<std::int32_t> lowest(refined.mesh.nodes.size(), ranks.count());
  for_each_element(refined.mesh, [&](std::size_t element, std::span<const std::int32_t> sites) {
    if (element >= refined.parents.size()) return;
    for (const std::int32_t site : sites) {
      std::int32_t& rank = lowest[static_cast<std::size_t>(site)];
      rank = std::min(rank, rank_of_element[element]);
    }
  });
  std::vector<bool> is_own;
  is_own.reserve(lowest.size());
  for (const std::int32_t rank : lowest) is_own.push_back(rank == ranks.own());
  return is_own;
}

/// 1 for each element, spring and mass that has one of the nodes.
std::vector<std::int32_t> elements_at(const mesher::Mesh& mesh, const std::vector<bool>& is_one) {
  std::vector<std::int32_t> marks;
  for_each_element(mesh, [&](std::size_t /*element*/, std::span<const std::int32_t> sites) {
    marks.push_back(std::any_of(sites.begin(), sites.end(),
                                [&](std::int32_t site) {
                                  return static_cast<std::size_t>(site) < is_one.size() &&
                                         is_one[static_cast<std::size_t>(site)];
                                })
                        ? 1
                        : 0);
  });
  return marks;
}

/// 1 for each element that has one of the nodes, and for each spring and mass at any node of these:
/// it belongs to a star though it may not reach the corner.
std::vector<std::int32_t> elements_around(const mesher::RefinedMesh& refined,
                                          const std::vector<bool>& is_one) {
  const std::size_t element_count = refined.parents.size();
  std::vector<std::int32_t> marks = elements_at(refined.mesh, is_one);
  std::vector<bool> is_near(is_one.size(), false);
  for_each_element(refined.mesh, [&](std::size_t element, std::span<const std::int32_t> sites) {
    if (element >= element_count || marks[element] == 0) return;
    for (const std::int32_t site : sites) is_near[static_cast<std::size_t>(site)] = true;
  });
  const std::vector<std::int32_t> near = elements_at(refined.mesh, is_near);
  for (std::size_t k = element_count; k < marks.size(); ++k) marks[k] = near[k];
  return marks;
}

/// Those of the nodes of a part.
std::vector<bool> of_part(const RankPart& part, const std::vector<bool>& is_one) {
  Eigen::MatrixXd values(static_cast<Eigen::Index>(is_one.size()), 1);
  for (std::size_t k = 0; k < is_one.size(); ++k) {
    values(static_cast<Eigen::Index>(k), 0) = is_one[k] ? 1 : 0;
  }
  std::vector<bool> result;
  const Eigen::MatrixXd own = part.rows_of_nodes(values);
  for (Eigen::Index k = 0; k < own.rows(); ++k) result.push_back(own(k, 0) > 0);
  return result;
}

}  // namespace

RefinedSystem::RefinedSystem(const AssembledSystem& coarse, const ShiftInverse& inverse,
                             const mesher::RefinedMesh& refined, const DofMap& dof_map,
                             const ModalOptions& options)
    : inverse_(inverse),
      rank_of_element_(ranks_of_pieces(coarse, refined)),
      fields_(dof_map, layout_of(coarse.ranks(), refined.mesh, dof_map, rank_of_element_)),
      part_(own_part(coarse.ranks(), refined.mesh, dof_map, rank_of_element_)),
      exchange_(fields_.layout(), rows_of(part_.blocks())),
      transfer_(coarse.fields(), fields_, refined.prolongation),
      has_cells_(std::any_of(
          refined.mesh.blocks.begin(), refined.mesh.blocks.end(),
          [](const mesher::ElementBlock& block) { return has_inner_node(block.kind); })),
      star_weight_(has_cells_ ? kStarWeight : find_star_weight(refined.mesh, options.formulation)) {
  const auto operator_of = [&](const RankPart& part) {
    return ElementOperator(part.mesh(), part.dof_map(), options.formulation,
                           part.columns_of_nodes(options.prestress_m));
  };
  operator_.emplace(operator_of(part_));
  if (!ranks().are_many()) {
    stars_ = std::make_unique<const StarPatches>(
        StarMesh{refined.mesh, dof_map, refined.parents, {}}, *operator_);
    return;
  }
  const std::vector<bool> is_own = own_nodes(ranks(), refined, rank_of_element_);
  const std::vector<std::int32_t> marks = elements_around(refined, is_own);
  RankPart around(refined.mesh, dof_map, marks, 1);
  GhostExchange exchange(fields_.layout(), rows_of(around.blocks()));
  ranks().together([&] {
    StarMesh mesh{around.mesh(), around.dof_map(), {}, of_part(around, is_own)};
    for (std::size_t e = 0; e < refined.parents.size(); ++e) {
      if (marks[e] == 1) mesh.parents.push_back(refined.parents[e]);
    }
    stars_ = std::make_unique<const StarPatches>(mesh, operator_of(around));
  });
  around_.emplace(Around{std::move(around), std::move(exchange)});
}

ElementOperator::Products RefinedSystem::products(const Eigen::MatrixXd& columns) const {
  if (!ranks().are_many()) return operator_->apply(columns);
  const ElementOperator::Products own = operator_->apply(exchange_.to_local(columns));
  return {exchange_.sum_to_own(own.forces), exchange_.sum_to_own(own.momenta)};
}

Eigen::MatrixXd RefinedSystem::forces(const Eigen::MatrixXd& columns) const {
  return exchange_.summed(columns,
                          [&](const Eigen::MatrixXd& rows) { return operator_->forces(rows); });
}

void RefinedSystem::precondition(const Eigen::MatrixXd& residuals,
                                 Eigen::MatrixXd& directions) const {
  transfer_.to_fine(inverse_.approximate(transfer_.to_coarse(residuals)), directions);
  add_solutions(&StarPatches::add_stars, star_weight_, residuals, directions);
}

void RefinedSystem::add_cells(double weight, const Eigen::MatrixXd& residuals,
                              Eigen::MatrixXd& sums) const {
  add_solutions(&StarPatches::add_cells, weight, residuals, sums);
}

void RefinedSystem::add_solutions(AddSolutions add, double weight, const Eigen::MatrixXd& residuals,
                                  Eigen::MatrixXd& sums) const {
  if (!around_) return ((*stars_).*add)(weight, residuals, sums);
  const Eigen::MatrixXd local = around_->exchange.to_local(residuals);
  Eigen::MatrixXd solutions = Eigen::MatrixXd::Zero(local.rows(), local.cols());
  ((*stars_).*add)(weight, local, solutions);
  sums += around_->exchange.sum_to_own(solutions);
}

}  // namespace flexneck::fe_modal
