// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/exchange/export_formats.h"

#include <algorithm>
#include <array>

namespace flexneck::pipeline {

namespace {

constexpr std::array<ExportFormat, 14> kFormats = {
    {{".msh", "mesh for gmsh", export_msh, true},
     {".inp", "input deck for CalculiX", export_deck},
     {".mtx", "stiffness and mass matrix in Matrix Market format", export_matrices},
     {".petsc", "stiffness and mass matrix in PETSc binary format", export_matrices},
     {".dat", "modes for the ATB", export_atb_modes},
     {".vtu", "mesh and modes, or stresses, for ParaView and meshio", export_modes_vtu, false,
      export_stress_vtu},
     {".pvd", "motion of a run for ParaView", nullptr, false, export_motion_pvd},
     {".csv", "all recorded values of a run", nullptr, false, export_motion_csv},
     {".mme", "channels of a run as an ISO-MME test", nullptr, false, export_mme_test},
     {".fem", "modal body for MBDyn", nullptr, false, export_mbdyn_body},
     {".SID_FEM", "modal body as standard input data", nullptr, false, export_sid_body},
     {".hdf5", "modal body for Exudyn", nullptr, false, export_exudyn_body},
     {".h5", "modal body from a .fem or .SID_FEM file", nullptr, false, import_body},
     {".fmu", "model as an FMU for co-simulation (FMI 3.0)", nullptr, false, export_fmu, true}}};

/// Extensions of files that hold a run or a body.
constexpr std::array<std::string_view, 3> kNoStudies = {".h5", ".fem", ".SID_FEM"};

}  // namespace

std::span<const ExportFormat> export_formats() { return kFormats; }

bool exports_file(const std::vector<std::string>& files, const std::filesystem::path& target) {
  const bool is_of_file = std::any_of(kFormats.begin(), kFormats.end(), [&](const auto& format) {
    return format.ending == target.extension() && format.write_file != nullptr &&
           format.write == nullptr;
  });
  return std::any_of(files.begin(), files.end(), [&](const std::string& file) {
    return is_of_file || std::any_of(kNoStudies.begin(), kNoStudies.end(),
                                     [&](auto ending) { return file.ends_with(ending); });
  });
}

}  // namespace flexneck::pipeline
