// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <nlohmann/json_fwd.hpp>

#include "mesher/drawing/outer_surface.h"
#include "pipeline/results/report/results.h"

namespace flexneck::pipeline {

/// Motions of neck, head, arm and loads in each run, in the form that page/body.js reads: the neck
/// by its modes, as a rigid body, or as plates with an interpolated surface between them (submeshes
/// as sections, and a chain of bodies). Runs of other models are left out.
/// @param most_frames  maximum number of frames of a run
/// @pre mesh and modes exist and belong together
nlohmann::ordered_json motions_of(const Results& results, const Study& study,
                                  const mesher::Surface& surface, Eigen::Index most_frames);

}  // namespace flexneck::pipeline
