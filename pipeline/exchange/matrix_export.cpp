// SPDX-License-Identifier: GPL-3.0-or-later

#include "fe_modal/algebra/petsc_session.h"
#include "fe_modal/exchange/exported_matrices.h"
#include "geometry/foundation/error.h"
#include "pipeline/exchange/export_formats.h"
#include "pipeline/parameter_studies/evaluation/modes_options.h"

namespace flexneck::pipeline {

void export_matrices(const CommandInput& input, mesher::Mesh& mesh) {
  const Study& study = input.study;
  if (!study.modes.fixed_directions.empty() || !study.modes.rigid_interfaces.empty()) {
    throw InputError(
        "matrices are written with three degrees of freedom per node; remove "
        "modes.fixed_directions and modes.rigid_interfaces");
  }
  if (study.modes.prestress)
    throw InputError(
        "matrices are written without the geometric stiffness of a prestress; remove "
        "modes.prestress");
  const fe_modal::ModalOptions options = modes_options(study, mesh);
  const fe_modal::DofMap dof_map = fe_modal::dof_map_of(mesh, options);
  if (dof_map.is_constrained()) {
    throw InputError(
        "matrices are written with three degrees of freedom per node, which is not possible with " +
        mesh.connections.text() +
        "; remove all except springs and masses at nodes, and supports in all directions");
  }
  const fe_modal::PetscSession session;
  const fe_modal::ImportedBody body =
      fe_modal::export_matrices(mesh, dof_map, formulation_of(study));
  const auto named = [&](const std::string& what) {
    std::filesystem::path path = input.target;
    path.replace_filename(path.stem().string() + what + path.extension().string());
    return path;
  };
  fe_modal::write_matrix(named("_K"), body.stiffness);
  fe_modal::write_matrix(named("_M"), body.mass);
  fe_modal::write_positions(named("_nodes"), body.nodes_m);
}

}  // namespace flexneck::pipeline
