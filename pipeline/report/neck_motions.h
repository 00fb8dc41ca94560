// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <nlohmann/json_fwd.hpp>

#include "mesher/drawing/outer_surface.h"
#include "pipeline/report/results.h"

namespace flexneck::pipeline {

/// How neck, head, arm and loads move in each run, as page/body.js reads it: the neck by its modes,
/// as a rigid body, or as plates between which its surface is drawn evenly (pieces as sections, and
/// a chain of bodies). A run of anything else is left out.
/// @param most_frames of a run
/// @pre mesh and modes are there and belong together
nlohmann::ordered_json motions_of(const Results& results, const Study& study,
                                  const mesher::Surface& surface, Eigen::Index most_frames);

}  // namespace flexneck::pipeline
