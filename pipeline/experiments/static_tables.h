// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "pipeline/experiments/static_test.h"
#include "pipeline/output/result_table.h"

namespace flexneck::pipeline {

/// What is known of a static test once it was run.
struct StaticEntry {
  CaseSection experiment;
  StaticTestSignals ramp;                  ///< moving
  StaticTestSignals settled;               ///< at rest
  std::optional<StaticTestSignals> chain;  ///< at rest, the neck as a chain of bodies
};

/// "static tests": the end of the ramp and the stiffness at its beginning and end.
/// @param has_own_moduli  whether the neck has moduli of its own in static tests
ResultTable static_table(const std::vector<StaticEntry>& entries, bool has_own_moduli);

/// "ramp against statics": by how much the moving neck lags.
ResultTable ramp_table(const std::vector<StaticEntry>& entries);

/// "linear against chain": where there is a chain; else without rows.
ResultTable chain_table(const std::vector<StaticEntry>& entries);

}  // namespace flexneck::pipeline
