// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/modal_analysis.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fe_modal/assembly.h"
#include "fe_modal/attached_mass.h"
#include "fe_modal/completeness.h"
#include "fe_modal/eigensolver.h"
#include "fe_modal/free_nodes.h"
#include "fe_modal/invariants.h"
#include "fe_modal/make_system.h"
#include "fe_modal/modal_options_check.h"
#include "fe_modal/mode_conventions.h"
#include "fe_modal/mode_naming.h"
#include "fe_modal/reduction/geometric_stiffness.h"
#include "fe_modal/reduction/reduction.h"
#include "fe_modal/rigid_average.h"
#include "mesher/mesh/bounding_box.h"

namespace flexneck::fe_modal {
namespace {

constexpr Eigen::Index kAttachedCount = 6;
/// Eigenvalues below this share of the shift are rigid-body motions of a free body.
constexpr double kRigidBody = 1e-6;
constexpr const char* kNotCertified = "not certified";

/// A held body has a definite stiffness. A free one is shifted below zero by a crude estimate of
/// its first eigenvalue, (c / L)^2 of the slowest material.
double shift_for(const mesher::Mesh& mesh, const ModalOptions& options) {
  if (!options.held_set.empty()) return 0;
  double slowest = HUGE_VAL;
  for (const mesher::ElementBlock& block : mesh.blocks) {
    const mesher::Material& material = mesh.materials.at(block.material);
    slowest = std::min(slowest, material.youngs_modulus_Pa / material.density_kg_m3);
  }
  return -slowest / mesher::bounding_box(mesh).extent_m().squaredNorm();
}

Eigen::VectorXd frequencies_Hz(const Eigen::VectorXd& eigenvalues) {
  return eigenvalues.cwiseMax(0).cwiseSqrt() / (2 * std::numbers::pi);
}

std::vector<Interface> reduce_interfaces(const ModalOptions& options,
                                         const std::vector<RigidAverage>& averages,
                                         const std::vector<StaticResponse>& responses,
                                         const std::vector<Eigen::Matrix3Xd>& shapes) {
  const auto m = static_cast<Eigen::Index>(shapes.size());
  const Eigen::Matrix3Xd zero = Eigen::Matrix3Xd::Zero(3, m);
  std::vector<Interface> interfaces;
  if (!options.held_interface.empty()) {
    interfaces.push_back({options.held_interface, options.held_position_m, zero, zero});
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

/// Position of an interface among options.interfaces; it is known to be there.
std::size_t interface_index(const ModalOptions& options, const std::string& name) {
  const auto found = std::find_if(options.interfaces.begin(), options.interfaces.end(),
                                  [&](const auto& interface) { return interface.name == name; });
  return static_cast<std::size_t>(found - options.interfaces.begin());
}

std::vector<InterfaceLoads> loads_of(const ModalOptions& options, const FreeNodes& free_nodes,
                                     const std::vector<RigidAverage>& averages) {
  const std::vector<std::string>& chosen = options.basis_interfaces;
  std::vector<InterfaceLoads> loads;
  for (std::size_t k = 0; k < averages.size(); ++k) {
    const std::string& name = options.interfaces[k].name;
    loads.push_back(interface_loads(name, averages[k], free_nodes));
    loads.back().corrects_basis =
        chosen.empty() || std::find(chosen.begin(), chosen.end(), name) != chosen.end();
  }
  return loads;
}

/// The modes, none missing if that is asked for, and the certificate.
CertifiedModes normal_modes(const ModalSystem& system, const ShiftInverse& inverse,
                            const ModalOptions& options) {
  CertifiedModes modes = options.certify
                             ? certified_modes(system, inverse, options.mode_count)
                             : CertifiedModes{lowest_eigenpairs(system.stiffness(), system.mass(),
                                                                inverse, options.mode_count),
                                              kNotCertified};
  for (double& value : modes.pairs.values) {
    if (value < kRigidBody * -inverse.shift()) value = 0;
  }
  return modes;
}

/// The basis asked for and its certificate.
std::pair<Reduction, std::string> reduced_basis(const ModalSystem& system,
                                                const ShiftInverse& inverse,
                                                const ModalOptions& options,
                                                const std::vector<InterfaceLoads>& loads,
                                                const Progress& progress) {
  const BodyOperators operators = operators_of(system, inverse);
  if (options.basis == BasisKind::craig_bampton) {
    const auto solve = [&](Mat mass, Eigen::Index count) {
      return lowest_eigenpairs(system.stiffness(), mass, inverse, count);
    };
    return {craig_bampton(operators, system.mass(), solve, options.mode_count, loads, progress),
            kNotCertified};
  }
  const auto [pairs, certificate] = normal_modes(system, inverse, options);
  return {complete_modes(operators, pairs, loads, options.basis, progress), certificate};
}

std::vector<AttachedFrequencies> attach_bodies(const ModalOptions& options,
                                               const FreeNodes& free_nodes,
                                               const ModalSystem& system,
                                               const ShiftInverse& inverse,
                                               const std::vector<RigidAverage>& averages) {
  std::vector<AttachedFrequencies> result;
  for (const RigidAttachment& body : options.attachments) {
    const RigidAverage& region = averages[interface_index(options, body.interface)];
    const Matrix6d rigid_mass =
        rigid_mass_matrix(body.mass_kg, body.center_m - region.point_m(), body.inertia_kg_m2);
    const AttachedMass mass(system.mass(), free_nodes, region, rigid_mass);
    const EigenPairs pairs = lowest_eigenpairs(system.stiffness(), mass.matrix(), inverse,
                                               std::min(kAttachedCount, free_nodes.dof_count()));
    result.push_back({body.name, body.interface, frequencies_Hz(pairs.values), rigid_mass});
  }
  return result;
}

}  // namespace

ModalBody analyse_modes(const mesher::Mesh& mesh, const ModalOptions& options,
                        const Progress& progress) {
  const auto report = [&](const std::string& line) {
    if (progress) progress(line);
  };
  check_options(mesh, options);
  const bool held = !options.held_set.empty();
  const FreeNodes free_nodes(
      mesh, held ? mesh.node_set(options.held_set).nodes : std::vector<std::int32_t>{});
  report("assembling stiffness and mass, " + std::to_string(free_nodes.dof_count()) +
         " degrees of freedom");
  const std::unique_ptr<const ModalSystem> owned_system = make_system(mesh, free_nodes, options);
  const ModalSystem& system = *owned_system;

  report("factorising the stiffness");
  const double shift = shift_for(mesh, options);
  const std::unique_ptr<const ShiftInverse> inverse = system.shift_inverse(shift);
  report(inverse->describe());
  report("solving for " + std::to_string(options.mode_count) + " modes");
  std::vector<RigidAverage> averages;
  for (const InterfaceDefinition& interface : options.interfaces) {
    averages.emplace_back(mesh, mesh.face_set(interface.set), interface.position_m);
  }
  const std::vector<InterfaceLoads> loads = loads_of(options, free_nodes, averages);
  auto [basis, certificate] = reduced_basis(system, *inverse, options, loads, progress);
  EigenPairs& pairs = basis.pairs;
  if (options.sign_interface.empty()) {
    apply_conventions(pairs);
  } else {
    apply_conventions(pairs, free_nodes, averages[interface_index(options, options.sign_interface)],
                      options.length_m);
  }

  report("reducing to modal coordinates");
  ModalBody body;
  body.frequencies_Hz = frequencies_Hz(pairs.values);
  body.boundary = held ? "fixed: " + options.held_set : "free";
  body.certificate = certificate;
  body.nodes_m.resize(3, free_nodes.node_count());
  for (Eigen::Index k = 0; k < free_nodes.node_count(); ++k) {
    body.nodes_m.col(k) =
        Eigen::Map<const Eigen::Vector3d>(mesh.nodes[static_cast<std::size_t>(k)].data());
  }
  for (const auto& vector : pairs.vectors.colwise()) {
    body.shapes.push_back(free_nodes.expand(vector));
  }
  body.modes = describe_modes(mesh, options, basis.kinds, body.shapes,
                              relative_residuals(system.stiffness(), system.mass(), pairs, shift));
  body.interfaces = reduce_interfaces(options, averages, basis.responses, body.shapes);
  body.invariants = inertia_invariants(system.nodal_mass(), mesh.nodes, body.shapes);
  const Eigen::MatrixXd& modal_mass = body.invariants.Maa;
  body.orthogonality =
      (modal_mass - Eigen::MatrixXd::Identity(modal_mass.rows(), modal_mass.cols()))
          .cwiseAbs()
          .maxCoeff();
  if (options.geometric_stiffness) {
    report("integrating the geometric stiffness");
    body.geometric_stiffness =
        unit_load_stiffness(mesh, options.formulation, free_nodes, system.nodal_mass(),
                            operators_of(system, *inverse), loads, body.shapes);
  }
  if (!options.attachments.empty()) report("solving with rigid bodies attached");
  body.attached = attach_bodies(options, free_nodes, system, *inverse, averages);
  return body;
}

}  // namespace flexneck::fe_modal
