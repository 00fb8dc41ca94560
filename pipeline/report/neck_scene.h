// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "pipeline/report/results.h"

namespace flexneck::pipeline {

/// What the page shows in three dimensions, as page/scene.js reads it: the boundary of the mesh,
/// the mode shapes on it, and how neck and head move in each run whose modes are among them. Null
/// without a mesh and its modes.
nlohmann::ordered_json scene_of(const Results& results, const Study& study);

}  // namespace flexneck::pipeline
