// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/parameter_studies/evaluation/modes_options.h"

#include <algorithm>

#include "geometry/foundation/error.h"
#include "geometry/foundation/names.h"
#include "mesher/mesh/bounding_box.h"
#include "pipeline/parameter_studies/evaluation/study_connections.h"

namespace flexneck::pipeline {

namespace {

/// Name of the single fixed set, or of the union of several, which is added to the mesh.
std::string fixed_set(const std::vector<std::string>& fixed, mesher::Mesh& mesh) {
  if (fixed.empty()) return {};
  if (fixed.size() == 1) return mesh.node_set(fixed.front()).name;
  mesher::NodeSet all;
  for (const std::string& name : fixed) {
    const std::vector<std::int32_t>& nodes = mesh.node_set(name).nodes;
    all.name += (all.name.empty() ? "" : ", ") + name;
    all.nodes.insert(all.nodes.end(), nodes.begin(), nodes.end());
  }
  std::sort(all.nodes.begin(), all.nodes.end());
  all.nodes.erase(std::unique(all.nodes.begin(), all.nodes.end()), all.nodes.end());
  mesh.node_sets.push_back(all);
  return all.name;
}

/// Fails if an interface that is not fixed has no face set.
/// @throws InputError
void require_face_set(const mesher::Mesh& mesh, const InterfaceSection& interface) {
  try {
    static_cast<void>(mesh.face_set(interface.set));
  } catch (const InputError& error) {
    throw InputError("interface." + interface.name + ".set: " + error.what() +
                     "; a node set is allowed if modes.fixed names it");
  }
}

void add_interfaces(const Study& study, const mesher::Mesh& mesh, fe_modal::ModalOptions& options) {
  const std::vector<std::string>& fixed = study.modes.fixed;
  for (const InterfaceSection& interface : study.interfaces) {
    if (std::find(fixed.begin(), fixed.end(), interface.set) == fixed.end()) {
      require_face_set(mesh, interface);
      options.interfaces.push_back({interface.name, interface.set, interface.position_m});
      continue;
    }
    if (!options.fixed_interface.empty()) {
      throw InputError("interface." + interface.name + ": interface '" + options.fixed_interface +
                       "' is already at fixed nodes; only one interface can be");
    }
    options.fixed_interface = interface.name;
    options.fixed_position_m = interface.position_m;
  }
  if (!options.interfaces.empty()) options.sign_interface = options.interfaces.front().name;
}

void attach_body(const Study& study, fe_modal::ModalOptions& options) {
  const ModesSection& modes = study.modes;
  if (modes.attached_body.empty()) return;
  if (options.interfaces.empty()) {
    throw InputError("modes.attached_body: there is no [[interface]] to attach it to");
  }
  const std::size_t where = modes.attached_to.empty() ? 0
                                                      : find_name(names_of(options.interfaces),
                                                                  modes.attached_to, "interface");
  const fe_modal::InterfaceDefinition& interface = options.interfaces[where];
  const multibody::RigidBody& body = study.rigid_body(modes.attached_body);
  options.attachments = {{modes.attached_body, interface.name, body.mass_kg,
                          interface.position_m + body.center_m, body.inertia_kg_m2}};
}

void tie_interfaces(const Study& study, fe_modal::ModalOptions& options) {
  for (const std::string& name : study.modes.rigid_interfaces) {
    try {
      if (name == options.fixed_interface) throw InputError("'" + name + "' is at fixed nodes");
      const std::size_t which = find_name(names_of(options.interfaces), name, "interface");
      options.interfaces[which].is_rigid = true;
    } catch (const InputError& error) {
      throw InputError("modes.rigid_interfaces: " + std::string(error.what()));
    }
  }
}

}  // namespace

fe_modal::FormulationChoice formulation_of(const Study& study) {
  fe_modal::FormulationChoice choice = {.of_others = study.modes.formulation};
  for (const auto& [material, model] : study.material_models()) {
    if (model.formulation) choice.of_material[material] = *model.formulation;
  }
  return choice;
}

fe_modal::ModalOptions options_of_solution(const Study& study) {
  fe_modal::ModalOptions options;
  options.mode_count = study.modes.count;
  options.check = study.modes.check;
  options.solver = study.modes.solver;
  options.petsc_options = study.modes.petsc_options;
  return options;
}

fe_modal::ModalOptions modes_options(const Study& study, mesher::Mesh& mesh) {
  fe_modal::ModalOptions options = options_of_solution(study);
  options.formulation = formulation_of(study);
  options.basis = study.modes.basis;
  options.basis_interfaces = study.modes.basis_interfaces;
  options.slit_motions = study.modes.slit_motions;
  options.geometric_stiffness = study.modes.stress_stiffening;
  if (study.modes.prestress) options.prestress = study.loads;
  options.rigid_parts = study.modes.rigid_parts;
  options.fixed_directions = study.modes.fixed_directions;
  options.length_m = mesher::bounding_box(mesh).extent_m().maxCoeff();
  try {
    add_study_connections(study, mesh);
    options.fixed_set = fixed_set(study.modes.fixed, mesh);
    add_interfaces(study, mesh, options);
    attach_body(study, options);
    tie_interfaces(study, options);
  } catch (const InputError& error) {
    throw InputError(study.file.string() + ": " + error.what());
  }
  return options;
}

}  // namespace flexneck::pipeline
