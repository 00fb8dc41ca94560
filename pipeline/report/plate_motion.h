// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "mesher/drawing/outer_surface.h"
#include "pipeline/report/results.h"

namespace flexneck::pipeline {

/// The structure as rigid plates with sections between them: where each vertex of its surface
/// rides.
struct Plates {
  std::vector<std::string> markers;   ///< of the plates, from the fixed end on
  std::vector<std::uint8_t> section;  ///< of each vertex: between plates k and k + 1
  Eigen::VectorXf share;              ///< of the upper plate, 0 to 1, even through the rubber
};

/// Of a case whose sections are pieces of the structure, stacked along z; none of any other.
std::optional<Plates> plates_of(const Study& study, const CaseSection& experiment,
                                const mesher::Mesh& mesh, const mesher::Surface& surface);

/// Of a run of the structure cut into a chain of bodies, which are joined at the markers; none of a
/// study without pieces, or with pieces that are not stacked along z.
std::optional<Plates> links_of(const Study& study, const mesher::Mesh& mesh,
                               const mesher::Surface& surface);

/// The plates' motion against the first: rotation matrix and translation that take a point from
/// where it is without load, both in the frame of the mesh. Twelve numbers a plate (rows of R, then
/// t), a column for each output time.
/// @pre the run begins with the neck as good as undeformed, and has the markers
Eigen::MatrixXd plate_motion(const Plates& plates, const multibody::History& history);

}  // namespace flexneck::pipeline
