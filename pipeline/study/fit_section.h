// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "pipeline/document/curve_file.h"
#include "pipeline/document/study_document.h"
#include "pipeline/study/corridor_table.h"

namespace flexneck::pipeline {

/// [[fit.parameter]]: numbers in its unit.
struct FitParameter {
  std::string name;
  std::string key;   ///< dotted, of the study
  std::string unit;  ///< empty for pure numbers
  double from = 0;
  double to = 0;
  std::optional<double> start;  ///< none: the study's value
  /// A normal prior, cut off at the bounds; none: a uniform one.
  std::optional<double> mean;
  double standard_deviation = 0;
};

/// What a target has of a curve.
struct FitCurve {
  std::string output;  ///< the curve of the study
  Curve target;        ///< over the time of the case, in the file's unit; none of a corridor
  std::optional<CurveCorridor> corridor;  ///< in its place: a window at each point
  double from_s = 0;
  double to_s = 0;
  int points = 0;  ///< at equal distances, as which it counts
  /// Rated as a whole instead: 0 by ISO/TS 18571, 1 by CORA.
  std::optional<std::size_t> rating;
};

/// [[fit.target]]: a value with its standard deviation, or a window. Texts have their units, which
/// the output's kind decides.
struct FitTarget {
  std::string name;
  std::string output;             ///< a figure; empty of a curve or an expression
  std::string expression;         ///< of the parameters by name, each in its unit
  std::optional<FitCurve> curve;  ///< none of a figure
  std::string value;
  std::string standard_deviation;            ///< absolute, or …
  std::optional<double> relative_deviation;  ///< … a share of the value
  std::string low, high;                     ///< of a window; empty: open on that side
  std::string smoothing;                     ///< of a window; empty: a tenth of its width
  bool is_held_out = false;                  ///< predicted only
  bool must_hold = false;                    ///< a window that a fit keeps to
  StudyTable table;                          ///< that says so; for messages

  bool is_window() const { return !low.empty() || !high.empty(); }
};

/// [fit]
struct FitSection {
  enum class Method { local, global };
  Method method = Method::local;
  int evaluations = 1000;  ///< of a global search, at most
  int starts = 8;
  int seed = 1;
  int iterations = 40;            ///< of each start, at most
  bool has_profiles = true;       ///< confidence by profile likelihood
  int history_samples = 0;        ///< points of the prior that are tried
  double history_deviations = 3;  ///< within which a value counts as met there
  std::vector<FitParameter> parameters;
  std::vector<FitTarget> targets;
  std::vector<std::string> choices;  ///< that were made with the targets in sight
};

std::span<const Key> fit_keys();

/// Reads the section and the files of its curves, which are appended to `files`.
/// @throws InputError with file, line and key.
FitSection read_fit(const StudyTable& table);

/// [fit] of a study. @throws InputError if it has none.
FitSection read_fit(const std::filesystem::path& study, const std::vector<std::string>& settings);

}  // namespace flexneck::pipeline
