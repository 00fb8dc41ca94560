// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <nlohmann/json_fwd.hpp>

#include "pipeline/results/report/results.h"

namespace flexneck::pipeline {

/// Maximum number of frames of a run alone on its page: more than a screen shows at a tenth of real
/// speed.
inline constexpr Eigen::Index kMaxFrames = 400;

/// Data of the page's three-dimensional scene, in the form that page/scene.js reads: the boundary
/// of the mesh, the mode shapes on it, and the motion of neck and head in each run whose modes are
/// among them. Null without a mesh and its modes.
/// @param most_frames  maximum number of frames of a run
nlohmann::ordered_json scene_of(const Results& results, const Study& study,
                                Eigen::Index most_frames = kMaxFrames);

}  // namespace flexneck::pipeline
