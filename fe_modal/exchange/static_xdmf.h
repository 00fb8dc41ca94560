// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "fe_modal/body/static_solution.h"
#include "mesher/mesh/mesh.h"

namespace flexneck::fe_modal {

/// Stresses of one material at all nodes of a mesh, for programs that colour grids by them.
struct SpreadStresses {
  std::string material;
  std::vector<double> tensor_Pa;     ///< (n, 9), row-major; NaN at nodes of other materials
  std::vector<double> von_mises_Pa;  ///< (n), NaN at the same nodes
};
std::vector<SpreadStresses> spread_stresses(const StaticSolution& solution);

/// Writes "stress.xdmf" beside "stress.h5" for ParaView: a grid for each part of the mesh with its
/// displacements, its reactions and the stresses of its material. Positions, displacements and
/// reactions are read from the solution's file, stresses from "stress_view.h5" beside it, the
/// elements from "mesh_view.h5", which mesher::write_xdmf() writes.
/// @param file the file already written from `solution`, in the folder of mesh_file
/// @pre solution has the nodes of the mesh
/// @throws InputError if the folder cannot be written.
void write_static_xdmf(const std::filesystem::path& file, const std::filesystem::path& mesh_file,
                       const mesher::Mesh& mesh, const StaticSolution& solution);

}  // namespace flexneck::fe_modal
