// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "pipeline/laboratory/curve_file.h"
#include "pipeline/language/document/study_document.h"
#include "pipeline/language/study/corridor_table.h"

namespace flexneck::pipeline {

/// Content of [[fit.parameter]]: numbers in its unit.
struct FitParameter {
  std::string name;
  std::string key;   ///< dotted key in the study
  std::string unit;  ///< unit of its numbers; empty for pure ones
  double from = 0;
  double to = 0;
  std::optional<double> start;  ///< none: the study's value
  /// Mean of a normal prior, truncated at the bounds; none: a uniform prior.
  std::optional<double> mean;
  double standard_deviation = 0;
};

/// Curve of a target.
struct FitCurve {
  std::string output;  ///< name of the study's curve
  Curve target;        ///< over the time of the case, in the file's unit; empty for a corridor
  std::optional<CurveCorridor> corridor;  ///< used instead of the curve: a window at each point
  double from_s = 0;
  double to_s = 0;
  int points = 0;  ///< number of equidistant points at which it is compared
  /// Rating used instead of points: 0 for ISO/TS 18571, 1 for CORA.
  std::optional<std::size_t> rating;
};

/// Content of [[fit.target]]: a value with its standard deviation, or a window. Texts contain their
/// units, whose dimension is that of the output.
struct FitTarget {
  std::string name;
  std::string output;             ///< a figure; empty for a curve or an expression
  std::string expression;         ///< in terms of the parameters by name, each in its unit
  std::optional<FitCurve> curve;  ///< none for a figure
  std::string value;
  std::string standard_deviation;            ///< absolute, or …
  std::optional<double> relative_deviation;  ///< … as a fraction of the value
  std::string low, high;                     ///< bounds of a window; empty: open on that side
  std::string smoothing;                     ///< for a window; empty: a tenth of its width
  bool is_held_out = false;                  ///< predicted only, not fitted
  bool must_hold = false;                    ///< a window that is a constraint of the fit
  StudyTable table;                          ///< the target's table, for messages

  bool is_window() const { return !low.empty() || !high.empty(); }
};

/// Content of [fit].
struct FitSection {
  enum class Method { local, global };
  Method method = Method::local;
  int evaluations = 1000;  ///< maximum for a global search
  int starts = 8;
  int seed = 1;
  int iterations = 40;       ///< maximum for each start
  bool has_profiles = true;  ///< true if confidence is found by profile likelihood
  int history_samples = 0;   ///< points of the prior that are evaluated
  /// Deviations within which a value counts as met in history matching.
  double history_deviations = 3;
  std::vector<FitParameter> parameters;
  std::vector<FitTarget> targets;
  std::vector<std::string> choices;  ///< choices made with knowledge of the targets
};

std::span<const Key> fit_keys();

/// Reads the section and the files of its curves, which are recorded by FilesRead.
/// @throws InputError with file, line and key.
FitSection read_fit(const StudyTable& table);

/// Reads [fit] of a study. @throws InputError if it has none.
FitSection read_fit(const std::filesystem::path& study, const std::vector<std::string>& settings);

}  // namespace flexneck::pipeline
