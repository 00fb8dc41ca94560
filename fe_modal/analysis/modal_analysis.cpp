// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/analysis/modal_analysis.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fe_modal/algebra/petsc_choices.h"
#include "fe_modal/analysis/attached_frequencies.h"
#include "fe_modal/analysis/discretisation_error.h"
#include "fe_modal/analysis/estimate_limits.h"
#include "fe_modal/analysis/prestress.h"
#include "fe_modal/analysis/slit_basis.h"
#include "fe_modal/analysis/sound_factor.h"
#include "fe_modal/reduction/geometric_stiffness.h"
#include "fe_modal/reduction/invariants.h"
#include "fe_modal/reduction/mode_conventions.h"
#include "fe_modal/reduction/mode_naming.h"
#include "fe_modal/reduction/particles.h"
#include "fe_modal/reduction/reduction.h"
#include "fe_modal/reduction/static_response.h"
#include "fe_modal/solve/assembled_system.h"
#include "fe_modal/solve/eigensolver.h"
#include "fe_modal/solve/mechanism.h"
#include "fe_modal/solve/sturm_check.h"
#include "fe_modal/system/assembly.h"
#include "fe_modal/system/memory_needs.h"
#include "fe_modal/system/modal_options_check.h"
#include "fe_modal/system/rigid_average.h"
#include "geometry/foundation/error.h"
#include "mesher/mesh/positions.h"

namespace flexneck::fe_modal {
namespace {

/// Refuses a mechanism that has passed the factorisation by rounding: its lowest mode shows it.
void check_no_mechanism(const AssembledSystem& system, const EigenPairs& pairs) {
  const Eigen::Index rigid = system.model().rigid().count();
  if (pairs.values.size() <= rigid) return;
  if (are_strainless(system, pairs.vectors.col(rigid))[0]) refuse_mechanism(system, rigid == 0);
}

std::vector<Interface> reduce_interfaces(const ModalOptions& options,
                                         const std::vector<RigidAverage>& averages,
                                         const std::vector<StaticResponse>& responses,
                                         const std::vector<Eigen::Matrix3Xd>& shapes) {
  const auto m = static_cast<Eigen::Index>(shapes.size());
  const Eigen::Matrix3Xd zero = Eigen::Matrix3Xd::Zero(3, m);
  std::vector<Interface> interfaces;
  if (!options.fixed_interface.empty()) {
    interfaces.push_back({options.fixed_interface, options.fixed_position_m, zero, zero});
  }
  for (std::size_t k = 0; k < averages.size(); ++k) {
    Interface interface { options.interfaces[k].name, averages[k].point_m(), zero, zero };
    for (Eigen::Index l = 0; l < m; ++l) {
      const Vector6d motion = averages[k].of(shapes[static_cast<std::size_t>(l)]);
      interface.translation.col(l) = motion.head<3>();
      interface.rotation.col(l) = motion.tail<3>();
    }
    if (!responses.empty()) interface.response = responses[k];
    interfaces.push_back(interface);
  }
  return interfaces;
}

std::vector<ModeRecord> describe_modes(const mesher::Mesh& mesh, const ModalOptions& options,
                                       const std::vector<std::string>& kinds,
                                       const std::vector<Eigen::Matrix3Xd>& shapes,
                                       const Eigen::VectorXd& residuals) {
  std::vector<RigidAverage> parts;
  for (const std::string& name : options.rigid_parts) parts.emplace_back(mesh, name);
  std::vector<Shares> shares;
  shares.reserve(shapes.size());
  for (const Eigen::Matrix3Xd& shape : shapes) shares.push_back(motion_shares(parts, shape));
  const std::vector<std::string> names = mode_names(shares, kinds);
  std::vector<ModeRecord> records;
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    records.push_back({names[k], kinds[k], shares[k], residuals[static_cast<Eigen::Index>(k)]});
  }
  return records;
}

std::vector<InterfaceLoads> loads_of(const ModalOptions& options, const FieldMap& field_map,
                                     const std::vector<RigidAverage>& averages) {
  const std::vector<std::string>& chosen = options.basis_interfaces;
  std::vector<InterfaceLoads> loads;
  for (std::size_t k = 0; k < averages.size(); ++k) {
    const std::string& name = options.interfaces[k].name;
    loads.push_back(interface_loads(name, averages[k], field_map));
    loads.back().corrects_basis =
        chosen.empty() || std::find(chosen.begin(), chosen.end(), name) != chosen.end();
  }
  return loads;
}

void warn_of_rigid_cut(Eigen::Index count, Eigen::Index rigid_count, const Progress& warn) {
  if (count >= rigid_count || !warn) return;
  const std::string all = std::to_string(rigid_count);
  warn("the number of modes, " + std::to_string(count) + ", splits the " + all +
       " rigid-body modes of the body, of which any combination is a mode; request at least " +
       all);
}

/// The requested basis, the result of the check of its completeness, and the fields of slits that
/// joined it.
struct Basis {
  Reduction reduction;
  std::string completeness;
  std::vector<SlitField> slit_fields = {};
};

/// Data that the steps of an analysis share.
struct Analysis {
  const Model& model;
  const AssembledSystem& system;
  const LinearSolver& inverse;
  const Progress& progress;
  const Progress& warn;
  std::vector<RigidAverage> averages = {};  ///< one for each of the options' interfaces
  std::vector<InterfaceLoads> loads = {};   ///< one for each of the options' interfaces

  const ModalOptions& options() const { return model.options(); }
  BodyOperators operators() const { return operators_of(system, inverse); }
  void report(const std::string& line) const {
    if (progress) progress(line);
  }
};

/// Lowest modes of the body, with the result of the check of their completeness.
CheckedModes normal_modes(const Analysis& of) {
  CheckedModes modes = lowest_modes(of.system, of.inverse, of.options().mode_count,
                                    of.system.rigid_modes(), of.options().check, of.warn);
  of.report(modes.pairs.search);
  check_no_mechanism(of.system, modes.pairs);
  check_eigenvalues(modes.pairs.values, of.inverse.shift());
  warn_of_rigid_cut(modes.pairs.values.size(), of.model.rigid().count(), of.warn);
  return modes;
}

Basis reduced_basis(const Analysis& of) {
  const ModalOptions& options = of.options();
  if (options.slit_motions != SlitMotions::none) {
    SlitBasis basis = slit_basis(of.model, of.operators(), of.loads, of.progress);
    return {std::move(basis.reduction), kNotChecked, std::move(basis.fields)};
  }
  if (options.basis == BasisKind::craig_bampton) {
    const auto solve = [&](Mat mass, Eigen::Index count) {
      EigenPairs pairs = lowest_eigenpairs(mass, of.inverse, count);
      of.report(pairs.search);
      check_no_mechanism(of.system, pairs);
      warn_of_cut(pairs, of.inverse.shift(), of.warn);
      return pairs;
    };
    return {craig_bampton(of.operators(), of.system.mass(), solve, options.mode_count, of.loads,
                          of.progress),
            kNotChecked};
  }
  const auto [pairs, completeness] = normal_modes(of);
  return {complete_modes(of.operators(), pairs, of.loads, options.basis, of.model.rigid().count(),
                         of.progress),
          completeness};
}

/// Number of the basis vectors, the first ones, that are the body's own eigenvectors, its lowest.
Eigen::Index eigenvector_count(const Reduction& basis) {
  return std::count_if(basis.kinds.begin(), basis.kinds.end(), [](const std::string& kind) {
    return kind == kNormalMode || kind == kRigidMode;
  });
}

std::vector<std::vector<Eigen::Matrix3Xd>> interface_responses(
    const FieldMap& field_map, const BodyOperators& body,
    const std::vector<InterfaceLoads>& loads) {
  std::vector<std::vector<Eigen::Matrix3Xd>> responses;
  responses.reserve(loads.size());
  for (const InterfaceLoads& interface : loads) {
    responses.push_back(field_map.expand(static_response_beyond(body, {}, interface.forces)));
  }
  return responses;
}

/// Modal body of a basis, without the results that need more solves.
ModalBody body_of(const Analysis& of, const Basis& basis, const std::vector<Particle>& particles) {
  const ModalOptions& options = of.options();
  const mesher::Mesh& mesh = of.model.mesh();
  const EigenPairs& pairs = basis.reduction.pairs;
  ModalBody body;
  body.frequencies_Hz = frequencies_Hz(pairs.values);
  body.boundary = of.model.boundary() + (options.prestress.empty() ? "" : "; prestressed");
  body.prestress = prestress_text(options);
  body.completeness = basis.completeness;
  body.nodes_m = mesher::positions_of(mesh);
  body.shapes = of.system.fields().expand(pairs.vectors);
  if (!options.prestress.empty()) {
    body.prestress_stiffness =
        geometric_stiffness(mesh, options.formulation, body.shapes, {options.prestress_m})
            .front()
            .diagonal();
  }
  body.modes = describe_modes(
      mesh, options, basis.reduction.kinds, body.shapes,
      relative_residuals(of.system.stiffness(), of.system.mass(), of.inverse, pairs));
  body.slits = slit_motions(mesh, basis.slit_fields, body.shapes);
  body.interfaces = reduce_interfaces(options, of.averages, basis.reduction.responses, body.shapes);
  body.invariants = inertia_invariants(
      [&](const Eigen::MatrixXd& columns) { return of.system.mass_integrals(columns); }, mesh.nodes,
      body.shapes, particles);
  const Eigen::MatrixXd& modal_mass = body.invariants.Maa;
  body.orthogonality =
      (modal_mass - Eigen::MatrixXd::Identity(modal_mass.rows(), modal_mass.cols()))
          .cwiseAbs()
          .maxCoeff();
  return body;
}

void make_signs_unique(const Analysis& of, EigenPairs& pairs) {
  const ModalOptions& options = of.options();
  const FieldMap& fields = of.system.fields();
  if (options.sign_interface.empty()) return apply_conventions(pairs, fields.layout());
  apply_conventions(pairs, fields, of.averages[interface_index(options, options.sign_interface)],
                    options.length_m);
}

void add_mesh_errors(const Analysis& of, EigenPairs pairs, Eigen::Index eigenvectors,
                     ModalBody& body) {
  pairs.values.conservativeResize(eigenvectors);
  pairs.vectors.conservativeResize(Eigen::NoChange, eigenvectors);
  const std::vector<MeshError> errors = mesh_errors(of.system, pairs, of.progress);
  for (std::size_t k = 0; k < errors.size(); ++k) body.modes[k].mesh_error = errors[k];
  body.mesh_error_limits = limits_of_estimate(of.model.mesh(), of.options());
  if (!body.mesh_error_limits.empty() && of.warn)
    of.warn("the estimated discretisation errors are only indicative: " + body.mesh_error_limits);
}

}  // namespace

ModalBody analyse_modes(const mesher::Mesh& mesh, const ModalOptions& options,
                        const Progress& progress, StepTimes* step_times, const Progress& warn,
                        AnalysisFields* fields) {
  StepTimes unseen;
  StepTimes& times = step_times != nullptr ? *step_times : unseen;
  const PetscChoices choices(options.petsc_options);
  mesher::check(mesh);
  times.start("order");
  Model model(mesh, options);
  check_options(model);
  check_memory(mesh, options);
  if (fields != nullptr && !options.prestress.empty())
    throw InputError("sensitivities of prestressed modes are not supported; remove the prestress");
  if (!options.prestress.empty()) times.start("static step");
  add_prestress(model, progress);
  if (const std::string text = large_prestress_text(model); warn && !text.empty()) warn(text);

  times.start("assemble");
  if (progress)
    progress("assembling stiffness and mass, " + std::to_string(model.dof_map().dof_count()) +
             " degrees of freedom");
  const AssembledSystem system(model);

  times.start("factorise");
  if (progress) progress("factorising the stiffness matrix");
  const bool fixed = model.rigid().count() == 0;
  const std::unique_ptr<const LinearSolver> inverse =
      options.prestress.empty() ? factorise_or_refuse(system, shift_of(model))
                                : factorise_prestressed(system);
  Analysis of{model, system, *inverse, progress, warn};
  of.report(inverse->describe());

  times.start("iterate");
  of.report("solving for " + std::to_string(options.mode_count) + " modes");
  for (const InterfaceDefinition& interface : options.interfaces)
    of.averages.emplace_back(mesh, mesh.face_set(interface.set), interface.position_m);
  of.loads = loads_of(options, system.fields(), of.averages);
  Basis basis = reduced_basis(of);
  EigenPairs& pairs = basis.reduction.pairs;
  make_signs_unique(of, pairs);

  times.start("post-process");
  of.report("reducing to modal coordinates");
  const std::vector<Particle> particles =
      particles_of(mesh, model.dof_map(), system.fields().layout().whole(pairs.vectors));
  ModalBody body = body_of(of, basis, particles);
  if (options.geometric_stiffness) {
    of.report("integrating the geometric stiffness");
    body.geometric_stiffness = unit_load_stiffness(
        mesh, options.formulation, system, of.operators(), of.loads, body.shapes, particles);
  }
  if (!options.attachments.empty()) {
    times.start("iterate with bodies attached");
    of.report("solving with rigid bodies attached");
  }
  body.attached = attach_bodies({system, *inverse, of.averages, of.loads},
                                fields != nullptr ? &fields->attached_shapes : nullptr);
  if (fields != nullptr) {
    times.start("static responses");
    if (fixed) fields->responses = interface_responses(system.fields(), of.operators(), of.loads);
    fields->next_Hz = std::sqrt(pairs.next) / (2 * std::numbers::pi);
  }
  const Eigen::Index eigenvectors = eigenvector_count(basis.reduction);
  if (options.check && eigenvectors > 0) {
    times.start("refine and solve again");
    add_mesh_errors(of, pairs, eigenvectors, body);
  }
  body.solver = inverse->describe();
  choices.require_used();
  times.stop();
  return body;
}

}  // namespace flexneck::fe_modal
