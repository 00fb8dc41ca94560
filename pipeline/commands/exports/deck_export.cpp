// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/core.h>

#include "mesher/exchange/inp_writer.h"
#include "pipeline/commands/exports/export_formats.h"
#include "pipeline/evaluation/modes_options.h"
#include "pipeline/evaluation/study_connections.h"

namespace flexneck::pipeline {

namespace {

/// A line about materials whose elements have pressures of their own, which a deck cannot say;
/// empty if there are none.
std::string mixed_materials(const mesher::Mesh& mesh, const fe_modal::FormulationChoice& choice) {
  std::string materials;
  for (const mesher::Material& material : mesh.materials) {
    if (choice.of(material) != fe_modal::Formulation::mixed_pressure) continue;
    materials += fmt::format("{}{} (Poisson's ratio {:g})", materials.empty() ? "" : ", ",
                             material.name, material.poissons_ratio);
  }
  if (materials.empty()) return {};
  return "formulation mixed_pressure is not carried over: the deck's elements are of displacements "
         "alone, and may be stiffer, in " +
         materials;
}

}  // namespace

void export_deck(const CommandInput& input, mesher::Mesh& mesh) {
  const Study& study = input.study;
  const fe_modal::FormulationChoice choice = formulation_of(study);
  add_study_connections(study, mesh);
  mesher::InpOptions options{.reduced = {},
                             .fixed = study.modes.fixed,
                             .fixed_directions = study.modes.fixed_directions,
                             .mode_count = study.modes.count};
  for (const mesher::Material& material : mesh.materials) {
    if (choice.of(material) == fe_modal::Formulation::reduced) {
      options.reduced.insert(material.name);
    }
  }
  mesher::write_inp(input.target, mesh, options);
  const std::string line = mixed_materials(mesh, choice);
  if (!line.empty()) input.console.warning(input.target.string() + ": " + line);
}

}  // namespace flexneck::pipeline
