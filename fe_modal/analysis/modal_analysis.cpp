// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/analysis/modal_analysis.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fe_modal/analysis/attached_frequencies.h"
#include "fe_modal/analysis/discretisation_error.h"
#include "fe_modal/analysis/estimate_limits.h"
#include "fe_modal/analysis/prestress.h"
#include "fe_modal/analysis/slit_basis.h"
#include "fe_modal/analysis/sound_factor.h"
#include "fe_modal/dofs/rigid_motions.h"
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
#include "fe_modal/system/elimination_order.h"
#include "fe_modal/system/memory_needs.h"
#include "fe_modal/system/modal_options_check.h"
#include "fe_modal/system/rigid_average.h"
#include "geometry/foundation/error.h"
#include "mesher/mesh/positions.h"

namespace flexneck::fe_modal {
namespace {

/// Rounding may let a mechanism through the factorisation: its lowest eigenvalues tell.
void check_no_mechanism(const mesher::Mesh& mesh, const AssembledSystem& system,
                        const Eigen::VectorXd& values, Eigen::Index rigid) {
  const double scale = eigenvalue_scale(mesh);
  const Eigen::Index last = std::min(rigid, values.size());
  if (last > 0 && values[last - 1] > kStrainless * scale) {
    throw ComputationError("the body has fewer motions without strain than the " +
                           std::to_string(rigid) + " that its supports leave");
  }
  if (values.size() <= rigid || values[rigid] > strainless_share(mesh) * scale) return;
  if (const auto motions = describe_mechanism(mesh, system, rigid == 0)) {
    refuse_mechanism(*motions);
  }
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
  warn("the number of modes, " + std::to_string(count) + ", cuts the " + all +
       " rigid-body motions of the body, of which any combination is one: ask for at least " + all);
}

/// The basis asked for, its certificate, and the ways in which slits part that joined it.
struct Basis {
  Reduction reduction;
  std::string certificate;
  std::vector<SlitField> slit_fields = {};
};

Basis reduced_basis(const mesher::Mesh& mesh, const AssembledSystem& system,
                    const ShiftInverse& inverse, const ModalOptions& options,
                    const std::vector<InterfaceLoads>& loads, Eigen::Index rigid_count,
                    const Progress& progress, const Progress& warn) {
  const BodyOperators operators = operators_of(system, inverse);
  if (options.slit_motions != SlitMotions::none) {
    SlitBasis basis = slit_basis(mesh, system.fields(), operators, options, loads, progress);
    return {std::move(basis.reduction), kNotCertified, std::move(basis.fields)};
  }
  if (options.basis == BasisKind::craig_bampton) {
    const auto solve = [&](Mat mass, Eigen::Index count) {
      EigenPairs pairs = lowest_eigenpairs(mass, inverse, count);
      warn_of_cut(pairs, inverse.shift(), warn);
      return pairs;
    };
    return {craig_bampton(operators, system.mass(), solve, options.mode_count, loads, progress),
            kNotCertified};
  }
  auto [pairs, certificate] =
      lowest_modes(system, inverse, options.mode_count, options.certify, warn);
  check_no_mechanism(mesh, system, pairs.values, rigid_count);
  check_eigenvalues(pairs.values, inverse.shift());
  warn_of_rigid_cut(pairs.values.size(), rigid_count, warn);
  pairs.values.head(std::min(rigid_count, pairs.values.size())).setZero();
  return {complete_modes(operators, pairs, loads, options.basis, rigid_count, progress),
          certificate};
}

/// How many of the basis, its first, are the body's own eigenvectors, which are its lowest.
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

}  // namespace

ModalBody analyse_modes(const mesher::Mesh& mesh, const ModalOptions& given,
                        const Progress& progress, StepTimes* step_times, const Progress& warn,
                        AnalysisFields* fields) {
  StepTimes unseen;
  StepTimes& times = step_times != nullptr ? *step_times : unseen;
  const auto report = [&](const std::string& line) {
    if (progress) progress(line);
  };
  check_options(mesh, given);
  check_memory(mesh, given);
  if (fields != nullptr && !given.prestress.empty()) {
    throw InputError("derivatives of prestressed modes are not offered: leave the prestress out");
  }
  if (!given.prestress.empty()) times.start("static step");
  const ModalOptions options = with_prestress(mesh, given, progress);
  if (const std::string text = large_prestress_text(mesh, options); warn && !text.empty())
    warn(text);
  times.start("order and factorise");
  const DofMap dof_map = numbered_dof_map_of(mesh, options);
  const RigidMotions rigid(mesh, connections_of(mesh, options), dof_map);
  const bool fixed = rigid.count() == 0;
  report("assembling stiffness and mass, " + std::to_string(dof_map.dof_count()) +
         " degrees of freedom");
  times.start("assemble");
  AssembledSystem system(mesh, dof_map, options);
  const FieldMap& field_map = system.fields();

  times.start("order and factorise");
  report("factorising the stiffness");
  // A fixed body has a definite stiffness; one that keeps rigid motions is shifted below zero.
  const double shift = fixed ? 0 : -eigenvalue_scale(mesh);
  const std::unique_ptr<const ShiftInverse> inverse =
      options.prestress.empty() ? factorise_or_refuse(mesh, system, shift)
                                : factorise_prestressed(mesh, dof_map, system, options);
  report(inverse->describe());
  times.start("iterate");
  report("solving for " + std::to_string(options.mode_count) + " modes");
  std::vector<RigidAverage> averages;
  for (const InterfaceDefinition& interface : options.interfaces) {
    averages.emplace_back(mesh, mesh.face_set(interface.set), interface.position_m);
  }
  const std::vector<InterfaceLoads> loads = loads_of(options, field_map, averages);
  auto [basis, certificate, slit_fields] =
      reduced_basis(mesh, system, *inverse, options, loads, rigid.count(), progress, warn);
  EigenPairs& pairs = basis.pairs;
  if (options.sign_interface.empty()) {
    apply_conventions(pairs, field_map.layout());
  } else {
    apply_conventions(pairs, field_map, averages[interface_index(options, options.sign_interface)],
                      options.length_m);
  }

  times.start("post-process");
  report("reducing to modal coordinates");
  ModalBody body;
  body.frequencies_Hz = frequencies_Hz(pairs.values);
  body.boundary =
      boundary_of(mesh, options, rigid) + (options.prestress.empty() ? "" : "; prestressed");
  body.prestress = prestress_text(options);
  body.certificate = certificate;
  body.nodes_m = mesher::positions_of(mesh);
  body.shapes = field_map.expand(pairs.vectors);
  if (!options.prestress.empty()) {
    body.prestress_stiffness =
        geometric_stiffness(mesh, options.formulation, body.shapes, {options.prestress_m})
            .front()
            .diagonal();
  }
  body.modes =
      describe_modes(mesh, options, basis.kinds, body.shapes,
                     relative_residuals(system.stiffness(), system.mass(), *inverse, pairs));
  const Eigen::Index eigenvectors = eigenvector_count(basis);
  body.slits = slit_motions(mesh, slit_fields, body.shapes);
  body.interfaces = reduce_interfaces(options, averages, basis.responses, body.shapes);
  const std::vector<Particle> particles =
      particles_of(mesh, dof_map, field_map.layout().whole(pairs.vectors));
  body.invariants = inertia_invariants(
      [&](const Eigen::MatrixXd& columns) { return system.mass_integrals(columns); }, mesh.nodes,
      body.shapes, particles);
  const Eigen::MatrixXd& modal_mass = body.invariants.Maa;
  body.orthogonality =
      (modal_mass - Eigen::MatrixXd::Identity(modal_mass.rows(), modal_mass.cols()))
          .cwiseAbs()
          .maxCoeff();
  if (options.geometric_stiffness) {
    report("integrating the geometric stiffness");
    body.geometric_stiffness =
        unit_load_stiffness(mesh, options.formulation, system, operators_of(system, *inverse),
                            loads, body.shapes, particles);
  }
  if (!options.attachments.empty()) {
    times.start("iterate with bodies attached");
    report("solving with rigid bodies attached");
  }
  body.attached = attach_bodies(options, {system, *inverse, averages, loads},
                                pairs.vectors.leftCols(eigenvectors),
                                fields != nullptr ? &fields->attached_shapes : nullptr);
  if (fields != nullptr) {
    times.start("static responses");
    if (fixed) {
      fields->responses = interface_responses(field_map, operators_of(system, *inverse), loads);
    }
    fields->next_Hz = std::sqrt(pairs.next) / (2 * std::numbers::pi);
  }
  if (options.certify && eigenvectors > 0) {
    times.start("refine and solve again");
    // A factor does without K, unlike an iteration.
    if (options.solver == Solver::direct) system.keep_mass_alone();
    // Nothing else needs the basis any more: its other columns go, and no copy is made.
    pairs.values.conservativeResize(eigenvectors);
    pairs.vectors.conservativeResize(Eigen::NoChange, eigenvectors);
    const auto errors =
        mesh_errors({mesh, system, pairs, *inverse, rigid.count()}, options, progress);
    for (std::size_t k = 0; k < errors.size(); ++k) body.modes[k].mesh_error = errors[k];
    body.mesh_error_limits = limits_of_estimate(mesh, options);
    if (!body.mesh_error_limits.empty() && warn)
      warn("the errors of the mesh are an indication alone: " + body.mesh_error_limits);
  }
  body.solver = inverse->describe();
  times.stop();
  return body;
}

}  // namespace flexneck::fe_modal
