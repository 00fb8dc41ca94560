// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "pipeline/experiments/static_test.h"
#include "pipeline/process/result_table.h"

namespace flexneck::pipeline {

/// Data of a static test after its run.
struct StaticEntry {
  CaseSection experiment;
  StaticTestSignals ramp;                  ///< moving
  StaticTestSignals settled;               ///< static solutions
  std::optional<StaticTestSignals> chain;  ///< static solutions with the neck as a chain of bodies
};

/// Table "static tests": the end of the ramp and the stiffness at its beginning and end.
/// @param has_own_moduli  whether the neck has separate moduli for static tests
ResultTable static_table(const std::vector<StaticEntry>& entries, bool has_own_moduli);

/// Table "ramp against statics": lag of the moving neck behind the static solution.
ResultTable ramp_table(const std::vector<StaticEntry>& entries);

/// Table "linear against chain"; without rows if there is no chain.
ResultTable chain_table(const std::vector<StaticEntry>& entries);

}  // namespace flexneck::pipeline
