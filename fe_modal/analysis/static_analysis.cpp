// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/analysis/static_analysis.h"

#include <cmath>
#include <memory>
#include <utility>

#include "fe_modal/algebra/petsc_choices.h"
#include "fe_modal/analysis/sound_factor.h"
#include "fe_modal/element/nodal_stresses.h"
#include "fe_modal/element/stressed_elements.h"
#include "fe_modal/reduction/operators.h"
#include "fe_modal/reduction/static_response.h"
#include "fe_modal/solve/assembled_system.h"
#include "fe_modal/solve/mechanism.h"
#include "fe_modal/system/assembly.h"
#include "fe_modal/system/memory_needs.h"
#include "fe_modal/system/modal_options_check.h"
#include "fe_modal/system/point_forces.h"
#include "fe_modal/system/supports.h"
#include "geometry/foundation/error.h"
#include "geometry/foundation/output_file.h"
#include "mesher/mesh/positions.h"

namespace flexneck::fe_modal {
namespace {

/// Largest norm of the free nodes' unbalanced forces, relative to the nodal forces of the elements:
/// rounding makes 1e-12 in slender bodies.
constexpr double kBalanced = 1e-6;

/// Refuses a mechanism that has passed the factorisation by rounding: loads then move it without
/// strain.
void refuse_moved_mechanism(const AssembledSystem& system, const Eigen::VectorXd& response) {
  if (response.squaredNorm() > 0 && are_strainless(system, response)[0])
    refuse_mechanism(system, true);
}

}  // namespace

StaticStep static_step(const Model& model, const std::vector<Load>& loads,
                       const Progress& progress) {
  require_supports(model.rigid(), "a static step");
  const mesher::Mesh& mesh = model.mesh();
  const ModalOptions& options = model.options();
  const DofMap& dof_map = model.dof_map();
  const Eigen::Matrix3Xd moved_m = support_displacements(mesh, options, loads);
  if (progress) {
    progress("static step, " + std::to_string(dof_map.dof_count()) + " degrees of freedom");
  }
  const AssembledSystem system(model);
  StaticStep step;
  step.applied_N = nodal_forces(mesh, system.nodal_mass(), loads);
  const Eigen::VectorXd weights = weights_at_points(mesh, dof_map, loads);
  Eigen::VectorXd load = dof_map.gather(step.applied_N) + weights;
  if (moved_m.cwiseAbs().maxCoeff() > 0)
    load -= dof_map.gather(internal_forces(mesh, options.formulation, moved_m));
  const std::unique_ptr<const LinearSolver> inverse = factorise_or_refuse(system, 0);
  Eigen::VectorXd response = Eigen::VectorXd::Zero(load.size());
  if (load.norm() > 0)
    response = static_response_beyond(operators_of(system, *inverse), {}, load).col(0);
  refuse_moved_mechanism(system, response);
  step.displacements_m = dof_map.expand(response) + moved_m;
  step.point_forces = weights - spring_forces(mesh, dof_map, response);
  step.solver = inverse->describe();
  return step;
}

Eigen::Matrix3Xd consistent_forces(const mesher::Mesh& mesh, const ModalOptions& options,
                                   const std::vector<Load>& loads) {
  const SystemMatrices system = assemble(mesh, dof_map_of(mesh, options), options.formulation);
  return nodal_forces(mesh, system.nodal_mass, loads);
}

StaticSolution analyse_static(const mesher::Mesh& mesh, const ModalOptions& options,
                              const std::vector<Load>& loads, const Progress& progress) {
  const PetscChoices choices(options.petsc_options);
  mesher::check(mesh);
  const Model model(mesh, options);
  require_supports(model.rigid(), "a static step");
  check_options(model);
  check_memory(mesh, options);
  StaticStep step = static_step(model, loads, progress);
  StaticSolution solution;
  solution.boundary = model.boundary();
  solution.solver = std::move(step.solver);
  for (const Load& load : loads) solution.loads.push_back(describe(load));
  solution.nodes_m = mesher::positions_of(mesh);

  if (progress) progress("stresses and reactions");
  const Eigen::Matrix3Xd internal_N =
      internal_forces(mesh, options.formulation, step.displacements_m);
  const Eigen::Matrix3Xd unbalanced_N = internal_N - step.applied_N;
  const double scale = std::max(internal_N.norm(), step.applied_N.norm());
  if (scale > 0) {
    solution.imbalance = (model.dof_map().gather(unbalanced_N) - step.point_forces).norm() / scale;
  }
  if (!(solution.imbalance < kBalanced))
    throw ComputationError(
        "the static step is not in equilibrium: " + rounded_text(solution.imbalance) +
        " of the forces remain unbalanced at free nodes");
  const std::vector<std::array<bool, 3>> reacting = reacting_directions_of(mesh, options);
  // Weights of masses at points are loads, transferred to nodes by connections.
  const Eigen::Matrix3Xd weights_N = weights_on_nodes(mesh, model.connections(), loads);
  solution.reactions_N = unbalanced_N - weights_N;
  for (std::size_t k = 0; k < reacting.size(); ++k) {
    for (std::size_t a = 0; a < 3; ++a) {
      if (!reacting[k][a])
        solution.reactions_N(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(k)) = 0;
    }
  }
  StressFields stresses = stress_fields(mesh, options.formulation, step.displacements_m);
  solution.at_nodes = std::move(stresses.at_nodes);
  solution.at_points = std::move(stresses.at_points);
  solution.displacements_m = std::move(step.displacements_m);
  solution.applied_N = step.applied_N + weights_N;
  choices.require_used();
  return solution;
}

}  // namespace flexneck::fe_modal
