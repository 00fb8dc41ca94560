// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "pipeline/document/curve_file.h"
#include "pipeline/document/study_document.h"
#include "pipeline/study/corridor_table.h"

namespace flexneck::pipeline {

/// [[test.curve]]: what was measured of a channel.
struct MeasuredCurve {
  std::string channel;           ///< of the case's run
  Curve curve;                   ///< over the time of the case, filtered, in the file's unit
  std::optional<double> from_s;  ///< what of it is rated; all that both curves have
  std::optional<double> to_s;
};

/// [[test.corridor]]: where a channel should run.
struct MeasuredCorridor : CurveCorridor {
  std::string channel;  ///< of the case's run
};

/// [[test.limit]]: where a figure of a channel should lie.
struct MeasuredLimit {
  enum class Figure { peak, time_of_peak, first_zero_crossing };
  std::string channel;
  Figure figure = Figure::peak;
  std::string low, high;  ///< with their units; empty: no limit
  StudyTable table;       ///< that says so; for messages
};

/// A [[test]] with data of the user's own.
struct MeasuredTest {
  std::string name;
  std::string experiment;  ///< the case
  std::vector<MeasuredCurve> curves;
  std::vector<MeasuredCorridor> corridors;
  std::vector<MeasuredLimit> limits;

  bool is_empty() const { return curves.empty() && corridors.empty() && limits.empty(); }
};

/// The tables curve, corridor and limit of a [[test]].
std::span<const Key> measured_keys();

/// Reads them and their files, which are appended to `files`.
/// @throws InputError with file, line and key, or file and line of what they name.
MeasuredTest read_measured(const StudyTable& test);

}  // namespace flexneck::pipeline
