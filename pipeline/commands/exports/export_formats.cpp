// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/commands/exports/export_formats.h"

#include <array>

namespace flexneck::pipeline {

namespace {

constexpr std::array<ExportFormat, 9> kFormats = {
    {{".msh", "the mesh for gmsh", export_msh, true},
     {".inp", "a deck for CalculiX", export_deck},
     {".mtx", "K and M in Matrix Market's format", export_matrices},
     {".petsc", "K and M in PETSc's", export_matrices},
     {".dat", "the modes for the ATB", export_atb_modes},
     {".vtu", "mesh and modes, or stresses, for ParaView, meshio", export_modes_vtu, false,
      export_stress_vtu},
     {".pvd", "the motion of a run for ParaView", nullptr, false, export_motion_pvd},
     {".csv", "all that a run records", nullptr, false, export_motion_csv},
     {".mme", "the channels of a run as ISO-MME", nullptr, false, export_mme_test}}};

}  // namespace

std::span<const ExportFormat> export_formats() { return kFormats; }

}  // namespace flexneck::pipeline
