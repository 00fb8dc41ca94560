// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/core.h>

#include "fe_modal/exchange/atb_modal_file.h"
#include "geometry/foundation/atomic_file.h"
#include "geometry/foundation/error.h"
#include "mesher/exchange/inp_writer.h"
#include "mesher/exchange/msh_writer.h"
#include "pipeline/commands/commands.h"
#include "pipeline/commands/matrices.h"
#include "pipeline/commands/structure_options.h"
#include "pipeline/isolation/result_files.h"

namespace flexneck::pipeline {

namespace {

/// The neck stands on its bolts.
std::vector<std::string> held_sets(const Study& study) {
  return study.geometry ? std::vector<std::string>{"bolts"} : study.modes.held;
}

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

void export_deck(const CommandInput& input, const mesher::Mesh& mesh) {
  const Study& study = input.study;
  const fe_modal::FormulationChoice choice = formulation_of(study);
  mesher::InpOptions options{.reduced = {},
                             .held = held_sets(study),
                             .held_directions = study.modes.held_directions,
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

/// The modes of this mesh for the ATB.
void export_modes(const CommandInput& input, const mesher::Mesh& mesh) {
  const fe_modal::ModalBodyFile modes = read_modal_body(input.folder.modes());
  require_same_inputs(input.folder.modes(), modes.provenance, input.study,
                      modes_provenance(input.study).parameters, "flexneck modes");
  if (modes.body.nodes_m.cols() != static_cast<Eigen::Index>(mesh.nodes.size())) {
    throw InputError(input.folder.modes().string() + ": belongs to another mesh than " +
                     input.folder.mesh().string() + "; make it again with 'flexneck modes'");
  }
  fe_modal::write_atb_modal_file(input.target, mesh, modes.body);
}

}  // namespace

bool export_command(const CommandInput& input) {
  const std::filesystem::path& target = input.target;
  if (target.empty()) {
    throw InputError("export: name the file to write, --to FILE.msh, .inp, .mtx, .petsc or .dat");
  }
  mesher::MeshFile mesh = read_mesh(input.folder.mesh());
  require_same_inputs(input.folder.mesh(), mesh.provenance, input.study, mesh_values(input.study),
                      "flexneck mesh");
  input.console.step("Writing " + target.string());
  try {
    if (target.extension() == ".msh") {
      mesher::write_msh(target, mesh.mesh,
                        input.is_binary ? mesher::MshEncoding::binary : mesher::MshEncoding::text);
    } else if (target.extension() == ".inp") {
      export_deck(input, mesh.mesh);
    } else if (is_matrix_file(target)) {
      export_matrices(input, mesh.mesh);
    } else if (target.extension() == ".dat") {
      export_modes(input, mesh.mesh);
    } else {
      throw InputError("expected a file with the ending .msh, .inp, .mtx, .petsc or .dat");
    }
  } catch (const InputError& error) {
    throw InputError(target.string() + ": " + error.what());
  }
  sync_folder(target.has_parent_path() ? target.parent_path() : ".");
  return true;
}

}  // namespace flexneck::pipeline
