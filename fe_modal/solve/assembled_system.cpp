// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/solve/assembled_system.h"

#include <algorithm>
#include <numeric>
#include <string>
#include <utility>

#include "fe_modal/algebra/cholesky_factor.h"
#include "fe_modal/algebra/cholmod_handles.h"
#include "fe_modal/algebra/inertia_count.h"
#include "fe_modal/algebra/mumps_count.h"
#include "fe_modal/dofs/node_graph.h"
#include "fe_modal/solve/distributed_factor.h"
#include "fe_modal/solve/iterative/schwarz_inverse.h"
#include "fe_modal/solve/iterative/single_inverse.h"
#include "fe_modal/system/assembly.h"
#include "fe_modal/system/elimination_order.h"
#include "geometry/foundation/error.h"
#include "mesher/partition/element_partition.h"
#include "mesher/partition/node_order.h"

namespace flexneck::fe_modal {
namespace {

/// With its blocks in the order of elimination, if it will be factorised and they can be so.
RankPart part_of(const ModalOptions& options, const mesher::Mesh& mesh, const DofMap& dof_map,
                 const std::vector<std::int32_t>& rank_of_element) {
  const Ranks& ranks = options.ranks;
  if (!ranks.are_many()) return {mesh, dof_map};
  RankPart part(mesh, dof_map, rank_of_element, ranks.own());
  if (options.solver == Solver::iterative || dof_map.is_constrained()) return part;
  const Separator separator(ranks, static_cast<std::size_t>(dof_map.free_count()), part.blocks());
  ranks.together(
      [&] { part.renumber(order_of_part(NodeGraph(part.mesh(), part.dof_map()), separator)); });
  return part;
}

void require_work_for_all(const std::vector<std::int32_t>& rank_of_element, int count) {
  std::vector<bool> has_work(static_cast<std::size_t>(count), false);
  for (const std::int32_t rank : rank_of_element) has_work[static_cast<std::size_t>(rank)] = true;
  const auto idle = std::find(has_work.begin(), has_work.end(), false);
  if (idle == has_work.end()) return;
  throw InputError("rank " + std::to_string(idle - has_work.begin()) + " of " +
                   std::to_string(count) + " gets none of the mesh's " +
                   std::to_string(rank_of_element.size()) + " elements: start fewer ranks");
}

/// Known from the beginning; else empty.
std::vector<std::int32_t> given_order(const ModalOptions& options, const DofMap& dof_map) {
  if (!dof_map.is_renumbered()) return order_of_blocks(options.node_order, dof_map);
  std::vector<std::int32_t> order(static_cast<std::size_t>(dof_map.free_count()));
  std::iota(order.begin(), order.end(), 0);
  return order;
}

}  // namespace

AssembledSystem::Sharing AssembledSystem::share_out(const mesher::Mesh& mesh, const DofMap& dof_map,
                                                    const ModalOptions& options) {
  const int count = options.ranks.count();
  Sharing sharing;
  if (options.solver == Solver::iterative) {
    sharing.subdomains = find_subdomains(mesh, dof_map, count);
    if (count > 1) sharing.rank_of_element = ranks_of_elements(mesh, *sharing.subdomains, count);
  } else if (count > 1) {
    sharing.rank_of_element = options.element_ranks.empty()
                                  ? mesher::partition_elements(mesh, count).processes
                                  : options.element_ranks;
  }
  if (count > 1) {
    require_work_for_all(sharing.rank_of_element, count);
    sharing.rank_of_element.resize(element_count(mesh), 0);  // springs and masses
  }
  return sharing;
}

AssembledSystem::AssembledSystem(const mesher::Mesh& mesh, const DofMap& dof_map,
                                 const ModalOptions& options)
    : AssembledSystem(mesh, dof_map, options, share_out(mesh, dof_map, options)) {}

AssembledSystem::AssembledSystem(const mesher::Mesh& mesh, const DofMap& dof_map,
                                 const ModalOptions& options, Sharing sharing)
    : mesh_(mesh),
      formulation_(options.formulation),
      prestress_m_(options.prestress_m),
      solver_(options.solver),
      sharing_(std::move(sharing)),
      fields_(dof_map, layout_of(options.ranks, mesh, dof_map, sharing_.rank_of_element)),
      part_(part_of(options, mesh, dof_map, sharing_.rank_of_element)),
      exchange_(fields_.layout(), rows_of(part_.blocks())),
      order_(given_order(options, dof_map)),
      has_order_(!order_.empty()) {
  ranks().together([&] {
    matrices_ = std::make_unique<SystemMatrices>(assemble(
        part_.mesh(), part_.dof_map(), formulation_, part_.columns_of_nodes(prestress_m_)));
  });
  const auto operator_of = [this](BlockOperator product) -> BlockOperator {
    return [this, product = std::move(product)](const Eigen::MatrixXd& columns) {
      return exchange_.summed(columns, product);
    };
  };
  stiffness_.emplace(fields_.own_dof_count(), operator_of(SymmetricProduct(matrices_->stiffness)),
                     ranks());
  mass_.emplace(fields_.own_dof_count(), operator_of([this](const Eigen::MatrixXd& columns) {
                  return block_product(matrices_->mass_operator(), columns);
                }),
                ranks());
}

const std::vector<std::int32_t>& AssembledSystem::order() const {
  if (has_order_) return order_;
  has_order_ = true;
  ranks().together([&] {
    if (!ranks().is_first()) return;
    const NodeGraph graph(mesh_, fields_.dof_map());
    order_ = mesher::nested_dissection(graph.offsets(), graph.columns());
  });
  return order_;
}

AssembledSystem::Elimination AssembledSystem::elimination() const {
  if (fields_.dof_map().is_renumbered()) return {CholmodOrder::numbering, {}};
  return {CholmodOrder::given, order()};
}

DistributedMatrix AssembledSystem::distributed(const SymmetricMatrix& summand) const {
  return {fields_.layout(), part_.blocks(), matrices_->graph, summand,
          part_.dof_map().is_renumbered()};
}

std::unique_ptr<ShiftInverse> AssembledSystem::shift_inverse(double shift) const {
  if (solver_ == Solver::iterative) {
    const CutBody body{mesh_, fields_, *sharing_.subdomains,
                       ranks_of_subdomains(mesh_, *sharing_.subdomains, ranks().count())};
    return std::make_unique<SchwarzInverse>(body, formulation_, prestress_m_, part_, *matrices_,
                                            stiffness(), mass(), shift);
  }
  return factor(shift, Precision::of_single);
}

std::unique_ptr<ShiftInverse> AssembledSystem::factor(double shift, Precision precision) const {
  std::optional<SymmetricMatrix> shifted;
  ranks().together([&] {
    if (shift != 0) shifted = shifted_stiffness(*matrices_, shift);
  });
  const SymmetricMatrix& matrix = shifted ? *shifted : matrices_->stiffness;
  const Matrices products{stiffness(), mass()};
  const auto make_in_double = [this, shift] { return factor(shift, Precision::of_double); };
  if (ranks().are_many()) {
    return precision == Precision::of_double
               ? make_distributed_in_double(distributed(matrix), shift)
               : make_shift_inverse(distributed(matrix), products, shift, make_in_double);
  }
  const auto [kind, given] = elimination();
  std::unique_ptr<ShiftInverse> inverse;
  if (precision == Precision::of_double) {
    inverse = std::make_unique<CholeskyFactor>(matrix.get(), shift, kind, given, ranks().threads());
  } else {
    inverse = make_shift_inverse(matrix.get(), products, shift, kind, given, ranks().threads(),
                                 make_in_double);
  }
  matrix.free_columns();  // products do without
  return inverse;
}

std::optional<Eigen::Index> AssembledSystem::eigenvalues_below(double sigma,
                                                               const Eigen::MatrixXd& known) const {
  try {
    std::optional<SymmetricMatrix> shifted;
    ranks().together([&] { shifted = shifted_stiffness(*matrices_, sigma); });
    const OperatorMatrix product(
        fields_.own_dof_count(),
        [&](const Eigen::MatrixXd& x) { return shifted_product(stiffness(), mass(), sigma, x); },
        ranks());
    const KnownVectors vectors{known, block_product(mass(), known)};
    std::optional<Eigen::Index> counted;
    if (ranks().are_many()) {
      counted = count_on_ranks(distributed(*shifted), product.get(), vectors);
    } else {
      const auto [kind, given] = elimination();
      counted = count_without_pivoting(shifted->get(), product.get(), kind, given, vectors,
                                       ranks().threads());
    }
    if (counted) return counted;
    return count_with_pivoting(fields_.layout(), *shifted, part_.blocks(), order());
  } catch (const InputError&) {  // the memory that is free does not suffice
    if (solver_ == Solver::direct) throw;
    return {};
  }
}

void AssembledSystem::keep_mass_alone() {
  stiffness_.reset();
  matrices_->stiffness.clear();
  matrices_->graph = NodeGraph({0}, {});
  NodalMass().swap(matrices_->nodal_mass);
}

Eigen::MatrixXd AssembledSystem::mass_integrals(const Eigen::MatrixXd& fields) const {
  const Eigen::MatrixXd own = part_.rows_of_nodes(fields);
  Eigen::MatrixXd integrals = own.transpose() * (matrices_->nodal_mass * own);
  ranks().sum(integrals);
  return integrals;
}

Eigen::MatrixXd AssembledSystem::inertia_forces(
    std::span<const Eigen::Matrix3Xd> accelerations) const {
  Eigen::MatrixXd forces(part_.dof_map().dof_count(),
                         static_cast<Eigen::Index>(accelerations.size()));
  for (Eigen::Index k = 0; k < forces.cols(); ++k) {
    const Eigen::MatrixXd own =
        part_.rows_of_nodes(accelerations[static_cast<std::size_t>(k)].transpose());
    forces.col(k) = part_.dof_map().gather((matrices_->nodal_mass * own).transpose());
  }
  return exchange_.sum_to_own(forces);
}

}  // namespace flexneck::fe_modal
