// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string_view>

#include "mesher/mesh/mesh.h"
#include "pipeline/commands/commands.h"

namespace flexneck::pipeline {

/// A kind of file that `export` writes to input.target. A new one is a function in a file of this
/// folder and a row in export_formats.cpp.
struct ExportFormat {
  std::string_view ending;
  std::string_view content;
  /// @param mesh of the folder; may be changed
  void (*write)(const CommandInput& input, mesher::Mesh& mesh);  ///< null if it is of a file
  bool may_be_binary = false;                                    ///< knows --binary
  void (*write_file)(const FileInput& input) = nullptr;  ///< of a file: a run, a body, a model
  bool takes_settings = false;                           ///< of the model
};

std::span<const ExportFormat> export_formats();

/// Whether `export` is of a file, not of a study's mesh: by the format to be written, which is of
/// files alone, or because a file is none of a study.
bool exports_file(const std::vector<std::string>& files, const std::filesystem::path& target);

/// The mesh for gmsh.
void export_msh(const CommandInput& input, mesher::Mesh& mesh);

/// A deck for CalculiX and Abaqus: mesh, materials, supports, the static step under the study's
/// loads, as forces of nodes, and the search for modes, about that step if it prestresses them.
void export_deck(const CommandInput& input, mesher::Mesh& mesh);

/// K and M without what is fixed as NAME_K.mtx and NAME_M.mtx, and the positions of the nodes as
/// NAME_nodes.mtx; in PETSc's binary format likewise.
void export_matrices(const CommandInput& input, mesher::Mesh& mesh);

/// The modes of this mesh for the ATB.
void export_atb_modes(const CommandInput& input, mesher::Mesh& mesh);

/// Mesh and modes, each mode under its name, as an unstructured grid of VTK.
void export_modes_vtu(const CommandInput& input, mesher::Mesh& mesh);

/// Mesh, displacements, reactions and the stresses of each material at the nodes, of the static
/// solution that is the only one of input.files; the mesh is that of its folder.
void export_stress_vtu(const FileInput& input);

/// How the nodes of a run's deformable body move in the world: NAME.pvd, and the folder NAME with a
/// grid of VTK for each time, at most 200. Mesh and modes are those of the run's folder.
/// @throws InputError for a run whose body's modes are not these.
void export_motion_pvd(const FileInput& input);

/// Markers, joints and modal coordinates of a run as one table in SI units, whose only line of
/// names tells the units.
void export_motion_csv(const FileInput& input);

/// The modal body of a file for MBDyn, as standard input data, for Exudyn; a warning tells what is
/// not carried over.
/// @throws InputError for a body with slits that open and close, or without interfaces.
void export_mbdyn_body(const FileInput& input);
void export_sid_body(const FileInput& input);
void export_exudyn_body(const FileInput& input);

/// A modal body of ours from a file of MBDyn (.fem) or standard input data (.SID_FEM); a warning
/// tells what is not carried over.
void import_body(const FileInput& input);

/// The model of a file as an FMU 3.0 for co-simulation (fmu/README.md).
void export_fmu(const FileInput& input);

/// The channels of a run, the only one of input.files, as a test of ISO-MME
/// (iso_mme/test_writer.h). A case's are those of the study that its folder remembers.
void export_mme_test(const FileInput& input);

}  // namespace flexneck::pipeline
