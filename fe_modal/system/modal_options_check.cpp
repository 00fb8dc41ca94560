// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/system/modal_options_check.h"

#include <algorithm>

#include <Eigen/QR>

#include "fe_modal/dofs/dof_map.h"
#include "geometry/foundation/error.h"
#include "geometry/foundation/names.h"
#include "mesher/mesh/positions.h"

namespace flexneck::fe_modal {
namespace {

/// Three nodes that are not on a line keep a body from turning.
void check_fixed(const mesher::Mesh& mesh, const std::string& set) {
  Eigen::Matrix3Xd positions = mesher::positions_of(mesh, mesh.node_set(set).nodes);
  positions.colwise() -= positions.rowwise().mean().eval();
  Eigen::ColPivHouseholderQR<Eigen::Matrix3Xd> decomposition(positions);
  decomposition.setThreshold(1e-6);
  if (decomposition.rank() < 2) {
    throw InputError("fixed set '" + set + "' has " + std::to_string(positions.cols()) +
                     " nodes on one line: the body can turn about it; fix an area");
  }
}

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

void check_interfaces(const mesher::Mesh& mesh, const ModalOptions& options) {
  std::vector<std::string> names = names_of(options.interfaces);
  for (const InterfaceDefinition& interface : options.interfaces) {
    static_cast<void>(mesh.face_set(interface.set));
  }
  if (!options.sign_interface.empty()) {
    static_cast<void>(find_name(names, options.sign_interface, "interface"));
    if (!(options.length_m > 0)) {
      throw InputError("the length that turns rotations into lengths must be positive, found " +
                       std::to_string(options.length_m) + " m");
    }
  }
  for (const RigidAttachment& attachment : options.attachments) {
    static_cast<void>(find_name(names, attachment.interface, "interface"));
    if (!options.is_fixed()) {
      throw InputError("rigid body '" + attachment.name +
                       "' is attached to a free body: name a set of nodes to fix");
    }
    if (!(attachment.mass_kg >= 0)) {
      throw InputError("the mass of rigid body '" + attachment.name + "' is negative");
    }
  }
  if (!options.fixed_interface.empty()) {
    if (options.fixed_set.empty()) {
      throw InputError("interface '" + options.fixed_interface +
                       "' is to lie on fixed nodes, but no set is fixed");
    }
    names.push_back(options.fixed_interface);
  }
  check_names(names, "interface");
  check_names(names_of(options.attachments), "attachment");
}

void check_basis(const ModalOptions& options, Eigen::Index dofs) {
  if (options.basis == BasisKind::normal) return;
  const std::string who =
      "basis '" + basis_names().at(static_cast<std::size_t>(options.basis)) + "'";
  const bool fixed = options.is_fixed();
  if (options.basis == BasisKind::inertia_relief && fixed) {
    const std::string& set =
        options.fixed_set.empty() ? options.fixed_directions.begin()->first : options.fixed_set;
    throw InputError(who + " is for a free body, but '" + set +
                     "' is fixed; take 'residual' or fix nothing");
  }
  if (options.basis != BasisKind::inertia_relief && !fixed) {
    throw InputError(who + " is for a fixed body, but nothing is fixed; take 'inertia-relief'");
  }
  if (options.interfaces.empty()) {
    throw InputError(who +
                     " adds the static shapes of interface loads: name an interface that is "
                     "not fixed");
  }
  const std::vector<std::string> names = names_of(options.interfaces);
  for (const std::string& name : options.basis_interfaces) {
    static_cast<void>(find_name(names, name, "interface"));
  }
  const auto constraints = static_cast<Eigen::Index>(
      6 * (options.basis_interfaces.empty() ? names.size() : options.basis_interfaces.size()));
  if (options.basis == BasisKind::craig_bampton && options.mode_count + constraints > dofs) {
    throw InputError(who + ": " + std::to_string(options.mode_count) + " modes with " +
                     std::to_string(constraints) + " fixed interface motions are more than the " +
                     std::to_string(dofs) + " degrees of freedom");
  }
}

void check_slit_motions(const mesher::Mesh& mesh, const ModalOptions& options) {
  if (options.slit_motions == SlitMotions::none) return;
  if (options.basis != BasisKind::craig_bampton || options.mode_count > 0)
    throw InputError(
        "slits that open and close join static shapes alone: take the basis 'craig-bampton' and no "
        "modes");
  if (std::all_of(mesh.slits.begin(), mesh.slits.end(),
                  [](const mesher::Slit& slit) { return slit.tied; }))
    throw InputError("slits that open and close: the mesh has no open slit");
}

void check_prestress(const ModalOptions& options) {
  if (options.prestress.empty()) return;
  check_names(names_of(options.prestress), "load");
  if (!options.is_fixed()) {
    throw InputError(
        "a prestress needs supports, but nothing is fixed: name node sets in modes.fixed or "
        "modes.fixed_directions");
  }
  if (options.geometric_stiffness || options.slit_motions != SlitMotions::none) {
    throw InputError(
        "a prestress is not offered with the geometric stiffness of unit loads, nor with slits "
        "that open and close: their loads would add to it");
  }
}

}  // namespace

void check_options(const mesher::Mesh& mesh, const ModalOptions& options) {
  mesher::check(mesh);
  check_parts(mesh, options);
  // With directions fixed besides, a line of nodes may be enough; if not, the mechanism is named.
  if (!options.fixed_set.empty() && options.fixed_directions.empty()) {
    check_fixed(mesh, options.fixed_set);
  }
  const DofMap dof_map = dof_map_of(mesh, options);
  const Eigen::Index dofs = dof_map.dof_count() - dof_map.fixed_direction_count();
  // Static shapes alone make a basis too.
  const int least = options.basis == BasisKind::craig_bampton ? 0 : 1;
  if (options.mode_count < least || options.mode_count > dofs) {
    throw InputError("the number of modes must lie between " + std::to_string(least) + " and the " +
                     std::to_string(dofs) + " degrees of freedom, found " +
                     std::to_string(options.mode_count));
  }
  check_interfaces(mesh, options);
  check_basis(options, dofs);
  check_slit_motions(mesh, options);
  check_prestress(options);
  if (options.geometric_stiffness && !options.is_fixed()) {
    throw InputError(
        "the geometric stiffness under unit loads is that of a fixed body: name a set "
        "of nodes to fix");
  }
}

}  // namespace flexneck::fe_modal
