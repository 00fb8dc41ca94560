// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "mesher/drawing/outer_surface.h"
#include "pipeline/results/report/results.h"

namespace flexneck::pipeline {

/// The structure as rigid plates with sections between them, and the interpolation of each vertex
/// of its surface.
struct Plates {
  std::vector<std::string> markers;   ///< markers of the plates, from the fixed end on
  std::vector<std::uint8_t> section;  ///< for each vertex, the k of the plates k and k + 1 round it
  Eigen::VectorXf share;  ///< weight of the upper plate, 0 to 1, linear through the rubber
};

/// Plates of a case whose sections are submeshes of the structure, stacked along z; none for other
/// cases.
std::optional<Plates> plates_of(const Study& study, const CaseSection& experiment,
                                const mesher::Mesh& mesh, const mesher::Surface& surface);

/// Plates of a run of the structure as a chain of bodies, which are joined at the markers; none for
/// a study without submeshes, or with submeshes that are not stacked along z.
std::optional<Plates> links_of(const Study& study, const mesher::Mesh& mesh,
                               const mesher::Surface& surface);

/// The plates' motion relative to the first: rotation matrix and translation that displace a point
/// from its unloaded position, both in the frame of the mesh. Twelve numbers a plate (rows of R,
/// then t), a column for each output time.
/// @pre the run begins with the neck practically undeformed, and has the markers
Eigen::MatrixXd plate_motion(const Plates& plates, const multibody::History& history);

}  // namespace flexneck::pipeline
