// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "pipeline/laboratory/curve_file.h"
#include "pipeline/language/document/study_document.h"
#include "pipeline/language/study/corridor_table.h"

namespace flexneck::pipeline {

/// Content of [[test.curve]]: a measured curve of a channel.
struct MeasuredCurve {
  std::string channel;  ///< channel of the case's run
  Curve curve;          ///< over the time of the case, filtered, in the file's unit
  /// Limits of the interval that is rated; by default the overlap of both curves.
  std::optional<double> from_s;
  std::optional<double> to_s;
};

/// Content of [[test.corridor]]: a corridor of a channel.
struct MeasuredCorridor : CurveCorridor {
  std::string channel;  ///< channel of the case's run
};

/// Content of [[test.limit]]: limits of a figure of a channel.
struct MeasuredLimit {
  enum class Figure { peak, time_of_peak, first_zero_crossing };
  std::string channel;
  Figure figure = Figure::peak;
  std::string low, high;  ///< with their units; empty: no limit
  StudyTable table;       ///< the limit's table, for messages
};

/// A [[test]] with measured data of the user.
struct MeasuredTest {
  std::string name;
  std::string experiment;  ///< name of the case
  std::vector<MeasuredCurve> curves;
  std::vector<MeasuredCorridor> corridors;
  std::vector<MeasuredLimit> limits;

  bool is_empty() const { return curves.empty() && corridors.empty() && limits.empty(); }
};

/// Keys of the tables curve, corridor and limit of a [[test]].
std::span<const Key> measured_keys();

/// Reads these tables and their files, which are recorded by FilesRead.
/// @throws InputError with file, line and key, or file and line of the named files.
MeasuredTest read_measured(const StudyTable& test);

}  // namespace flexneck::pipeline
