// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "multibody/equations/solver_options.h"
#include "pipeline/document/study_document.h"

namespace flexneck::pipeline {

/// Tolerances and steps; keys that are not there keep their values.
void read_steps(const StudyTable& solver, multibody::SolverOptions& options);

}  // namespace flexneck::pipeline
