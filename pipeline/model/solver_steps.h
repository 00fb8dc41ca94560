// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include "multibody/equations/solver_options.h"
#include "pipeline/document/study_document.h"

namespace flexneck::pipeline {

inline constexpr auto kStepKeys = std::to_array<Key>({
    Key::number("relative_tolerance", "1e-6", "Relative tolerance of a step", {.range = kPositive}),
    Key::number("absolute_tolerance", "1e-9", "Absolute tolerance of a step", {.range = kPositive}),
    Key::quantity("max_step", "s", "0.05", "Largest step", {.formerly = "largest_step"}),
    Key::quantity("min_step", "s", "1e-10", "Smallest step, below which a run ends",
                  {.range = kPositive, .formerly = "smallest_step"}),
});

/// Tolerances and steps: the keys kStepKeys.
void read_steps(const StudyTable& solver, multibody::SolverOptions& options);

}  // namespace flexneck::pipeline
