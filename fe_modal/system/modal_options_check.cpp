// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/system/modal_options_check.h"

#include <algorithm>

#include "geometry/foundation/error.h"
#include "geometry/foundation/names.h"
#include "geometry/foundation/output_file.h"

namespace flexneck::fe_modal {
namespace {

void check_parts(const mesher::Mesh& mesh, const ModalOptions& options) {
  std::vector<std::string> parts;
  for (const mesher::ElementBlock& block : mesh.blocks) {
    if (std::find(parts.begin(), parts.end(), block.part) == parts.end()) {
      parts.push_back(block.part);
    }
    try {
      static_cast<void>(
          element_scheme(block.kind, options.formulation.of(mesh.materials.at(block.material))));
    } catch (const InputError& error) {
      throw InputError("part '" + block.part + "': " + error.what());
    }
  }
  for (const auto& entry : options.formulation.of_material) {
    static_cast<void>(find_name(names_of(mesh.materials), entry.first, "material"));
  }
  for (const std::string& name : options.rigid_parts) {
    static_cast<void>(find_name(parts, name, "part"));
  }
}

constexpr Eigen::Index kAll = 6;  ///< number of rigid motions of a free body

/// Text of a body with rigid motions: "a free body", or "a body that slides along x".
std::string body_with(const RigidMotions& rigid) {
  return rigid.count() == kAll ? "a free body" : "a body that " + rigid.text();
}

void check_interfaces(const mesher::Mesh& mesh, const ModalOptions& options,
                      const RigidMotions& rigid) {
  std::vector<std::string> names = names_of(options.interfaces);
  for (const InterfaceDefinition& interface : options.interfaces) {
    static_cast<void>(mesh.face_set(interface.set));
  }
  if (!options.sign_interface.empty()) {
    static_cast<void>(find_name(names, options.sign_interface, "interface"));
    if (!(options.length_m > 0)) {
      throw InputError(
          "the length that scales rotations to displacements must be positive, found " +
          rounded_text(options.length_m) + " m");
    }
  }
  for (const RigidAttachment& attachment : options.attachments) {
    static_cast<void>(find_name(names, attachment.interface, "interface"));
    if (rigid.count() > 0) {
      throw InputError("rigid body '" + attachment.name + "' is attached to " + body_with(rigid) +
                       "; name a node set to fix");
    }
    if (!(attachment.mass_kg >= 0)) {
      throw InputError("the mass of rigid body '" + attachment.name + "' is negative");
    }
  }
  if (!options.fixed_interface.empty()) {
    if (options.fixed_set.empty()) {
      throw InputError("interface '" + options.fixed_interface +
                       "' is meant to be at fixed nodes, but no node set is fixed");
    }
    names.push_back(options.fixed_interface);
  }
  check_names(names, "interface");
  check_names(names_of(options.attachments), "attachment");
}

void check_basis(const mesher::Mesh& mesh, const ModalOptions& options, Eigen::Index dofs,
                 const RigidMotions& rigid) {
  if (options.basis == BasisKind::normal) return;
  const std::string who =
      "basis '" + basis_names().at(static_cast<std::size_t>(options.basis)) + "'";
  if (options.basis == BasisKind::inertia_relief && rigid.count() == 0) {
    throw InputError(who + " needs a body with rigid-body motions, but a body that is '" +
                     boundary_of(mesh, options, rigid) +
                     "' has none; use 'residual' or fix fewer directions");
  }
  if (options.basis != BasisKind::inertia_relief && rigid.count() > 0) {
    throw InputError(who + " needs a fixed body, but this is " + body_with(rigid) +
                     "; use 'inertia-relief'");
  }
  if (options.interfaces.empty()) {
    throw InputError(
        who + " adds the static shapes of interface loads; define an interface that is not fixed");
  }
  const std::vector<std::string> names = names_of(options.interfaces);
  for (const std::string& name : options.basis_interfaces) {
    static_cast<void>(find_name(names, name, "interface"));
  }
  const auto constraints = static_cast<Eigen::Index>(
      6 * (options.basis_interfaces.empty() ? names.size() : options.basis_interfaces.size()));
  if (options.basis == BasisKind::craig_bampton && options.mode_count + constraints > dofs) {
    throw InputError(who + ": " + std::to_string(options.mode_count) + " modes and " +
                     std::to_string(constraints) + " fixed interface motions are more than the " +
                     std::to_string(dofs) + " degrees of freedom");
  }
}

void check_slit_motions(const mesher::Mesh& mesh, const ModalOptions& options) {
  if (options.slit_motions == SlitMotions::none) return;
  const bool statics = options.basis == BasisKind::craig_bampton && options.mode_count == 0;
  if (options.basis != BasisKind::residual && !statics)
    throw InputError(
        "slits that open and close need static shapes; use the basis 'residual', or "
        "'craig-bampton' without modes");
  if (options.check || options.geometric_stiffness)
    throw InputError(
        "slits that open and close are not supported with modes.check, which requires a single "
        "stiffness matrix, or with stress_stiffening");
  if (std::all_of(mesh.slits.begin(), mesh.slits.end(),
                  [](const mesher::Slit& slit) { return slit.tied; }))
    throw InputError(
        "modes.slits is set for slits that open and close, but the mesh has no open slit");
}

/// Refuses connections whose forces rotate with the body: forces in couplings, including those of
/// rigid interfaces, and in springs would stiffen or soften it, which constraints and springs for
/// small motions leave out.
void refuse_turning_forces(const mesher::Mesh& mesh, const ModalOptions& options,
                           const std::string& what) {
  const mesher::Connections all = connections_of(mesh, options);
  mesher::Connections turning;
  turning.points = all.points;
  turning.couplings = all.couplings;
  turning.springs = all.springs;
  if (turning.empty()) return;
  throw InputError(what + " is not supported with " + turning.text() +
                   ", whose forces would rotate with the body; remove these");
}

void check_prestress(const mesher::Mesh& mesh, const ModalOptions& options,
                     const RigidMotions& rigid) {
  if (options.prestress.empty()) return;
  refuse_turning_forces(mesh, options, "a prestress");
  check_names(names_of(options.prestress), "load");
  require_supports(rigid, "a prestress");
  if (options.geometric_stiffness || options.slit_motions != SlitMotions::none) {
    throw InputError(
        "a prestress is not supported with the geometric stiffness under unit loads, or with slits "
        "that open and close, whose loads would be added to it");
  }
}

}  // namespace

void require_supports(const RigidMotions& rigid, const std::string& who) {
  if (rigid.count() == 0) return;
  throw InputError(who + " needs supports, but " +
                   (rigid.count() == kAll ? "nothing is fixed" : "the body " + rigid.text()) +
                   "; name node sets in modes.fixed or modes.fixed_directions");
}

namespace {

void check_resolved(const mesher::Mesh& mesh, const ModalOptions& options, const DofMap& dof_map,
                    const RigidMotions& rigid) {
  check_parts(mesh, options);
  const Eigen::Index dofs = dof_map.dof_count() - dof_map.dependent_count();
  // Static shapes alone are a basis too.
  const int least = options.basis == BasisKind::craig_bampton ? 0 : 1;
  if (options.mode_count < least || options.mode_count > dofs) {
    throw InputError("the number of modes must lie between " + std::to_string(least) + " and the " +
                     std::to_string(dofs) + " degrees of freedom, found " +
                     std::to_string(options.mode_count));
  }
  check_interfaces(mesh, options, rigid);
  check_basis(mesh, options, dofs, rigid);
  check_slit_motions(mesh, options);
  check_prestress(mesh, options, rigid);
  if (options.geometric_stiffness)
    refuse_turning_forces(mesh, options, "the geometric stiffness under unit loads");
  if (options.geometric_stiffness && rigid.count() > 0) {
    throw InputError("the geometric stiffness under unit loads needs a fixed body, but this is " +
                     body_with(rigid) + "; name a node set to fix");
  }
}

}  // namespace

void check_options(const mesher::Mesh& mesh, const ModalOptions& options) {
  mesher::check(mesh);
  const DofMap dof_map = dof_map_of(mesh, options);
  check_resolved(mesh, options, dof_map, {mesh, connections_of(mesh, options), dof_map});
}

void check_options(const Model& model) {
  check_resolved(model.mesh(), model.options(), model.dof_map(), model.rigid());
}

}  // namespace flexneck::fe_modal
