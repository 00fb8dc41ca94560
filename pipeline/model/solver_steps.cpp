// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/model/solver_steps.h"

namespace flexneck::pipeline {

void read_steps(const StudyTable& table, multibody::SolverOptions& options) {
  options.relative_tolerance = table.number_or("relative_tolerance", options.relative_tolerance);
  options.absolute_tolerance = table.number_or("absolute_tolerance", options.absolute_tolerance);
  options.max_step_s = table.quantity_or("largest_step", "s", options.max_step_s);
  options.min_step_s = table.quantity_or("smallest_step", "s", options.min_step_s);
  if (!(options.relative_tolerance > 0) || !(options.absolute_tolerance > 0)) {
    table.refuse("relative_tolerance", "expected positive tolerances");
  }
  if (!(options.min_step_s > 0) || !(options.max_step_s > options.min_step_s)) {
    table.refuse("largest_step", "expected 0 < smallest_step < largest_step");
  }
}

}  // namespace flexneck::pipeline
