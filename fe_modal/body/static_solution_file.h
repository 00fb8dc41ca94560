// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "fe_modal/body/static_solution.h"
#include "geometry/foundation/hdf5_file.h"
#include "geometry/foundation/provenance.h"

namespace flexneck::fe_modal {

/// File format; its layout is described in pipeline/manual/reference/stress_file.md.
inline constexpr FileFormat kStaticSolutionFormat{"flexneck static solution", 1, "flexneck stress"};

struct StaticSolutionFile {
  StaticSolution solution;
  Provenance provenance;
};

void write_static_solution(const std::filesystem::path& path, const StaticSolutionFile& file);
/// @throws InputError if the file is missing, truncated, foreign, inconsistent in its shapes, or if
/// reactions and loads are not in equilibrium.
StaticSolutionFile read_static_solution(const std::filesystem::path& path);

}  // namespace flexneck::fe_modal
