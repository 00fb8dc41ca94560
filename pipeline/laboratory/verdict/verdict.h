// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "pipeline/laboratory/verdict/pulse_rules.h"
#include "pipeline/laboratory/verdict/response_rules.h"

namespace flexneck::pipeline {

/// Curves that a test measures, SI units.
struct TestCurves {
  ResponseCurves response;
  PulseCurve pulse;
  double impact_velocity_m_s = 0;  ///< at the pendulum's accelerometer
};

/// Verdict of a test on curves. Conditions that are not met, velocity or pulse, cause warnings and
/// no failure.
struct Verdict {
  std::vector<JudgedFigure> figures;
  std::vector<JudgedFigure> conditions;

  bool passed() const;
  std::size_t passed_count() const;
  /// The figure furthest from the middle of its limits; a figure without a value counts as
  /// furthest.
  const JudgedFigure& furthest() const;
  std::vector<JudgedFigure> unmet_conditions() const;
};

/// Judges curves.
/// @throws std::invalid_argument for times that do not increase, or curves of unequal lengths.
Verdict judged(const CertificationTest& test, const TestCurves& curves);

}  // namespace flexneck::pipeline
