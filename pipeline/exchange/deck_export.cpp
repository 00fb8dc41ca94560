// SPDX-License-Identifier: GPL-3.0-or-later

#include <fmt/core.h>

#include "fe_modal/algebra/petsc_session.h"
#include "fe_modal/analysis/static_analysis.h"
#include "fe_modal/system/supports.h"
#include "mesher/exchange/inp_writer.h"
#include "pipeline/exchange/export_formats.h"
#include "pipeline/parameter_studies/evaluation/modes_options.h"
#include "pipeline/parameter_studies/evaluation/study_connections.h"

namespace flexneck::pipeline {

namespace {

/// Line about the materials whose elements have pressure degrees of freedom, which a deck cannot
/// express; empty if there are none.
std::string mixed_materials(const mesher::Mesh& mesh, const fe_modal::FormulationChoice& choice) {
  std::string materials;
  for (const mesher::Material& material : mesh.materials) {
    if (choice.of(material) != fe_modal::Formulation::mixed_pressure) continue;
    materials += fmt::format("{}{} (Poisson's ratio {:g})", materials.empty() ? "" : ", ",
                             material.name, material.poissons_ratio);
  }
  if (materials.empty()) return {};
  return "the formulation mixed_pressure is not carried over; the elements of the deck have "
         "displacements only and may be stiffer, in " +
         materials;
}

std::vector<std::array<double, 3>> rows_of(const Eigen::Matrix3Xd& columns) {
  std::vector<std::array<double, 3>> rows;
  for (const auto& column : columns.colwise()) rows.push_back({column[0], column[1], column[2]});
  return rows;
}

/// Converts the study's loads to nodal forces and displacements.
mesher::InpStaticStep static_step_of(const CommandInput& input, mesher::Mesh mesh) {
  const Study& study = input.study;
  const fe_modal::ModalOptions options = modes_options(study, mesh);
  const fe_modal::PetscSession session;
  return {rows_of(fe_modal::consistent_forces(mesh, options, study.loads)),
          rows_of(fe_modal::support_displacements(mesh, options, study.loads)),
          study.modes.prestress};
}

}  // namespace

void export_deck(const CommandInput& input, mesher::Mesh& mesh) {
  const Study& study = input.study;
  const fe_modal::FormulationChoice choice = formulation_of(study);
  mesher::InpOptions options{.reduced = {},
                             .fixed = study.modes.fixed,
                             .fixed_directions = study.modes.fixed_directions,
                             .mode_count = study.modes.count};
  for (const mesher::Material& material : mesh.materials) {
    if (choice.of(material) == fe_modal::Formulation::reduced) {
      options.reduced.insert(material.name);
    }
  }
  // static_step_of() adds the study's connections to its own copy of the mesh.
  if (!study.loads.empty()) options.static_step = static_step_of(input, mesh);
  add_study_connections(study, mesh);
  mesher::write_inp(input.target, mesh, options);
  const std::string line = mixed_materials(mesh, choice);
  if (!line.empty()) input.console.warning(input.target.string() + ": " + line);
}

}  // namespace flexneck::pipeline
