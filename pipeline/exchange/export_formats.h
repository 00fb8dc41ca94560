// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string_view>

#include "mesher/mesh/mesh.h"
#include "pipeline/run/command_input.h"

namespace flexneck::pipeline {

/// A kind of file that `export` writes to input.target. A new one is a function in a file of this
/// folder and a row in export_formats.cpp.
struct ExportFormat {
  std::string_view ending;
  std::string_view content;
  /// @param mesh mesh of the folder; may be changed
  /// Exports the study's mesh; null if the format takes a file.
  void (*write)(const CommandInput& input, mesher::Mesh& mesh);
  bool may_be_binary = false;  ///< knows --binary
  /// Exports a file (a run, a body or a model); null if the format takes none.
  void (*write_file)(const FileInput& input) = nullptr;
  bool takes_settings = false;  ///< accepts settings of the model
};

std::span<const ExportFormat> export_formats();

/// Returns whether `export` converts a file and not a study's mesh: either the target's format is
/// one for files only, or a given file is not a study.
bool exports_file(const std::vector<std::string>& files, const std::filesystem::path& target);

/// Writes the mesh for gmsh.
void export_msh(const CommandInput& input, mesher::Mesh& mesh);

/// Writes a deck for CalculiX and Abaqus: mesh, materials, supports, the static step under the
/// study's loads as nodal forces, and the modal step, about the static one if that is a prestress.
void export_deck(const CommandInput& input, mesher::Mesh& mesh);

/// Writes K and M without the fixed degrees of freedom as NAME_K.mtx and NAME_M.mtx, and the
/// positions of the nodes as NAME_nodes.mtx; or in PETSc's binary format.
void export_matrices(const CommandInput& input, mesher::Mesh& mesh);

/// Writes the modes of this mesh for the ATB.
void export_atb_modes(const CommandInput& input, mesher::Mesh& mesh);

/// Writes mesh and modes, each mode under its name, as an unstructured grid of VTK.
void export_modes_vtu(const CommandInput& input, mesher::Mesh& mesh);

/// Writes mesh, displacements, reactions and the nodal stresses of each material of the static
/// solution that is the only one of input.files; the mesh is that of its folder.
void export_stress_vtu(const FileInput& input);

/// Writes the motion of the nodes of a run's deformable body in the world frame: NAME.pvd, and the
/// folder NAME with a grid of VTK for each time, at most 200. Mesh and modes are read from the
/// run's folder.
/// @throws InputError for a run whose body has other modes.
void export_motion_pvd(const FileInput& input);

/// Writes markers, joints and modal coordinates of a run as one table in SI units, with the units
/// in its single line of column names.
void export_motion_csv(const FileInput& input);

/// Writes the modal body of a file for MBDyn, as standard input data, or for Exudyn; a warning
/// names what is not carried over.
/// @throws InputError for a body with slits that open and close, or without interfaces.
void export_mbdyn_body(const FileInput& input);
void export_sid_body(const FileInput& input);
void export_exudyn_body(const FileInput& input);

/// Converts a file of MBDyn (.fem) or standard input data (.SID_FEM) to a modal body of flexneck; a
/// warning names what is not carried over.
void import_body(const FileInput& input);

/// Writes the model of a file as an FMU 3.0 for co-simulation (manual/guides/exchange.md).
void export_fmu(const FileInput& input);

/// Writes the channels of a run, the only one of input.files, as a test in ISO-MME
/// (laboratory/iso_mme/test_writer.h). The channels of a case are those of the study that its
/// folder remembers.
void export_mme_test(const FileInput& input);

}  // namespace flexneck::pipeline
