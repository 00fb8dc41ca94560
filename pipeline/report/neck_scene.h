// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <nlohmann/json_fwd.hpp>

#include "pipeline/report/results.h"

namespace flexneck::pipeline {

/// Of a run alone on its page: more than a screen shows at a tenth of the real speed.
inline constexpr Eigen::Index kMaxFrames = 400;

/// What the page shows in three dimensions, as page/scene.js reads it: the boundary of the mesh,
/// the mode shapes on it, and how neck and head move in each run whose modes are among them. Null
/// without a mesh and its modes.
/// @param most_frames of a run
nlohmann::ordered_json scene_of(const Results& results, const Study& study,
                                Eigen::Index most_frames = kMaxFrames);

}  // namespace flexneck::pipeline
