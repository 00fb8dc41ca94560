// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/reduction/reduction.h"

#include "fe_modal/body/independent_loads.h"
#include "fe_modal/reduction/constrained_modes.h"
#include "fe_modal/reduction/ritz.h"
#include "fe_modal/reduction/static_response.h"
#include "geometry/foundation/error.h"

namespace flexneck::fe_modal {
namespace {

constexpr Eigen::Index kRigidMotions = 6;

/// Static shapes of all interfaces' loads, less what some modes have of them.
struct StaticShapes {
  Eigen::MatrixXd loads;       ///< F, (dofs, 6 p)
  Eigen::MatrixXd beyond;      ///< X less the modes' part, (dofs, 6 p)
  Eigen::MatrixXd rest;        ///< F^T times that
  Eigen::VectorXd compliance;  ///< diagonal of F^T X
  std::vector<StaticResponse> responses;
};

StaticShapes static_shapes(const BodyOperators& body, const EigenPairs& kept,
                           const std::vector<InterfaceLoads>& interfaces) {
  StaticShapes shapes;
  const auto count = static_cast<Eigen::Index>(6 * interfaces.size());
  shapes.loads.resize(interfaces.front().forces.rows(), count);
  for (std::size_t k = 0; k < interfaces.size(); ++k) {
    shapes.loads.middleCols<6>(static_cast<Eigen::Index>(6 * k)) = interfaces[k].forces;
  }
  shapes.beyond = static_response_beyond(body, kept, shapes.loads);
  shapes.rest = shapes.loads.transpose() * shapes.beyond;
  const Eigen::MatrixXd rest_mass = shapes.beyond.transpose() * body.mass(shapes.beyond);
  ModalResponse modal{Eigen::MatrixXd::Zero(count, count), Eigen::MatrixXd::Zero(count, count)};
  if (kept.values.size() > 0) {
    modal = modal_response(kept.values, kept.vectors.transpose() * shapes.loads);
  }
  const Eigen::MatrixXd compliance = modal.compliance + shapes.rest;
  const Eigen::MatrixXd mass = modal.mass + rest_mass;
  shapes.compliance = compliance.diagonal();
  for (Eigen::Index first = 0; first < count; first += 6) {
    const Matrix6d block = compliance.block<6, 6>(first, first);
    shapes.responses.push_back({(block + block.transpose()) / 2, mass.block<6, 6>(first, first)});
  }
  return shapes;
}

/// Combinations of the loads on interfaces that correct the basis.
Eigen::MatrixXd correcting_loads(const StaticShapes& shapes,
                                 const std::vector<InterfaceLoads>& interfaces,
                                 const Progress& progress) {
  std::vector<Eigen::Index> chosen;
  for (std::size_t k = 0; k < interfaces.size(); ++k) {
    if (!interfaces[k].corrects_basis) continue;
    for (std::size_t i = 0; i < 6; ++i) chosen.push_back(static_cast<Eigen::Index>(6 * k + i));
  }
  const IndependentLoads independent =
      independent_loads(shapes.rest(chosen, chosen), shapes.compliance(chosen));
  if (independent.dropped > 0 && progress) {
    progress(std::to_string(independent.dropped) + " of " + std::to_string(chosen.size()) +
             " correction modes are dropped: the other vectors of the basis hold them already");
  }
  const auto count = static_cast<Eigen::Index>(chosen.size());
  Eigen::MatrixXd combinations =
      Eigen::MatrixXd::Zero(shapes.rest.rows(), independent.combinations.cols());
  for (Eigen::Index i = 0; i < count; ++i) {
    combinations.row(chosen[static_cast<std::size_t>(i)]) = independent.combinations.row(i);
  }
  return combinations;
}

EigenPairs joined(const EigenPairs& lower, const EigenPairs& upper) {
  EigenPairs all{Eigen::VectorXd(lower.values.size() + upper.values.size()),
                 Eigen::MatrixXd(lower.vectors.rows(), lower.values.size() + upper.values.size())};
  all.values << lower.values, upper.values;
  all.vectors << lower.vectors, upper.vectors;
  return all;
}

}  // namespace

InterfaceLoads interface_loads(const std::string& name, const RigidAverage& average,
                               const DofMap& dof_map) {
  InterfaceLoads loads{name, Eigen::MatrixXd(dof_map.dof_count(), 6)};
  const auto weights = average.weights(dof_map.node_count());
  for (std::size_t i = 0; i < weights.size(); ++i) {
    loads.forces.col(static_cast<Eigen::Index>(i)) = dof_map.gather(weights[i]);
  }
  return loads;
}

Reduction complete_modes(const BodyOperators& body, const EigenPairs& normal,
                         const std::vector<InterfaceLoads>& interfaces, BasisKind kind,
                         const Progress& progress) {
  Reduction reduction;
  reduction.pairs = normal;
  for (const double value : normal.values) {
    reduction.kinds.emplace_back(value > 0 ? kNormalMode : kRigidMode);
  }
  const bool free = body.shift != 0;
  const bool all_rigid_motions = (normal.values.array() == 0).count() >= kRigidMotions;
  if (kind != BasisKind::normal && free && !all_rigid_motions) {
    throw InputError(
        "inertia relief needs all six rigid motions of the free body: ask for six modes or more");
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
  const ConstrainedMass constrained(mass, shapes.loads * combinations, responses);
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
