// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/core.h>

#include "fe_modal/body/modal_body_file.h"
#include "fe_modal/modal_analysis.h"
#include "geometry/foundation/error.h"
#include "geometry/foundation/units.h"
#include "mesher/mesh/mesh_file.h"
#include "pipeline/commands/commands.h"
#include "pipeline/text_table.h"

namespace flexneck::pipeline {

namespace {

fe_modal::ModalOptions modal_options(const Study& study) {
  const GeometrySection& geometry = *study.geometry;
  fe_modal::ModalOptions options;
  options.mode_count = study.modes.count;
  options.held_set = "bolts";
  options.held_interface = "base";
  options.interfaces = {{"top", "top", geometry.joint_point_m}};
  options.rigid_parts = {"base_plate", "plate_1", "plate_2", "plate_3", "top_plate"};
  options.length_m = geometry.neck.length;
  options.sign_interface = "top";
  if (!study.modes.attached_body.empty()) {
    // The body's frame has the axes of the neck and its origin at the joint point.
    const multibody::RigidBody& body = study.body(study.modes.attached_body).rigid;
    options.attachments = {{study.modes.attached_body, "top", body.mass_kg,
                            geometry.joint_point_m + body.center_m, body.inertia_kg_m2}};
  }
  return options;
}

std::string mode_table(const fe_modal::ModalBody& body) {
  std::vector<std::vector<std::string>> rows = {
      {"mode", "Hz", "fore-aft %", "lateral %", "twist %", "axial %", "residual"}};
  for (Eigen::Index k = 0; k < body.mode_count(); ++k) {
    const fe_modal::ModeRecord& mode = body.modes[static_cast<std::size_t>(k)];
    std::vector<std::string> row = {mode.name, fmt::format("{:.3f}", body.frequencies_Hz[k])};
    for (const double share : mode.shares_percent) row.push_back(fmt::format("{:.2f}", share));
    row.push_back(fmt::format("{:.1e}", mode.residual));
    rows.push_back(std::move(row));
  }
  return text_table(rows);
}

}  // namespace

bool modes_command(const CommandInput& input) {
  const mesher::MeshFile mesh = mesher::read_mesh(input.folder.mesh());
  require_same_inputs(input.folder.mesh(), mesh.provenance, input.study, "flexneck mesh");
  if (!input.study.geometry) {
    throw InputError(input.study.file.string() +
                     ": there is no [geometry] that names the interfaces");
  }
  input.console.step("Solving for " + std::to_string(input.study.modes.count) + " modes");
  const fe_modal::PetscSession session;
  fe_modal::ModalBodyFile file;
  file.body =
      fe_modal::analyse_modes(mesh.mesh, modal_options(input.study), input.console.detail());
  const std::string attached = "body." + input.study.modes.attached_body + ".";
  file.provenance = provenance_of(input.study, {"geometry.", "mesh.", "modes.", attached});
  file.provenance.inputs.push_back(
      {input.folder.mesh().filename().string(), hash_of_file(input.folder.mesh().string())});
  file.provenance.libraries = fe_modal::library_versions();
  fe_modal::write_modal_body(input.folder.modes(), file);

  const double mass_lb = file.body.invariants.mass * factor_from_si("kg", "lb");
  input.console.result(fmt::format("\nModes: {}, {}; mass {:.3f} lb  ({})\n{}", file.body.boundary,
                                   file.body.certificate, mass_lb, input.folder.modes().string(),
                                   mode_table(file.body)));
  return true;
}

}  // namespace flexneck::pipeline
