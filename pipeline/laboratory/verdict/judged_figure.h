// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "pipeline/laboratory/verdict/certification_test.h"

namespace flexneck::pipeline {

/// A figure that a rule evaluates from curves, and its limits.
struct JudgedFigure {
  std::string name;  ///< "peak rotation"
  std::string unit;  ///< SI
  Limits limits;
  std::optional<double> value;
  std::string problem;  ///< reason why there is no value

  bool is_inside() const { return value && limits.contains(*value); }
  /// Distance from the middle of the limits over half their distance: 1 at the upper one, -1 at the
  /// lower one. None without a value, or if there is one limit only.
  std::optional<double> half_corridors() const;
};

/// Judges a figure.
/// @param problem  applies if there is no value
JudgedFigure judged_figure(std::string name, const char* unit, const Limits& limits,
                           std::optional<double> value, const std::string& problem);

/// Texts of a figure, in the units of regulations.
struct FigureText {
  std::string value;   ///< "-" if there is none
  std::string limits;  ///< "64.0 to 78.0", "at most 29.00"
  std::string unit;
  std::string distance;  ///< half_corridors(), or the reason why there is none
};
FigureText text_of(const JudgedFigure& figure, const CertificationTest& test);

/// Text such as "pulse at 10 ms: 28.10 gn, 0.60 gn above 22.50 to 27.50 gn" for a figure outside
/// its limits.
std::string outside_text(const JudgedFigure& figure, const CertificationTest& test);

}  // namespace flexneck::pipeline
