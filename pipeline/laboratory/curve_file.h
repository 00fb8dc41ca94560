// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include <Eigen/Core>

#include "multibody/signals/cfc_filter.h"
#include "pipeline/laboratory/iso_mme/channel_code.h"

namespace flexneck::pipeline {

/// A column of a CSV file over its first one, the time, or a channel of an ISO-MME test.
struct Curve {
  std::string file;        ///< file name as given
  std::string column;      ///< name or code of the column; empty if the file has no line of names
  std::string unit;        ///< unit of the values; empty if the file names none
  Eigen::VectorXd time_s;  ///< shape (n), n > 1, strictly increasing
  Eigen::VectorXd values;  ///< shape (n), in `unit`, finite
  std::filesystem::path source = {};  ///< the file read: for a test, the channel's own
  /// Filter already applied by the channel's code; unknown for CSV.
  std::optional<MmeFilter> filter = {};

  /// Label "file: 'column' [unit]", without parts that are unknown.
  std::string label() const;
};

/// Reads a curve from a CSV file as flexneck writes it, with the first line "time [ms],name
/// [unit],…"; from a CSV file of two columns without that line, in seconds and an unknown unit; or
/// from a channel of a test in ISO-MME (laboratory/iso_mme/test_folder.h).
/// @param column  name, or code of ISO-MME; may be empty if there is only one
/// @throws InputError with file and line for another kind of file, a missing column, times that do
/// not increase and numbers that are not finite; and as read_mme_channel() does.
Curve read_curve(const std::filesystem::path& path, const std::string& column);

/// Converts the curve to another unit.
/// @throws InputError with the file and the column for a unit of another dimension.
Curve in_unit(Curve curve, const std::string& unit);

/// Returns whether a curve must be filtered to be of a class: not if its ISO-MME code says that it
/// has passed that class, since filtering twice would narrow the band. A curve filtered by a wider
/// class is filtered like an unfiltered one, as in SAE J211.
/// @throws InputError for a curve that has passed a narrower class or an unknown filter, since the
/// lost frequencies cannot be recovered.
bool needs_filter(const Curve& curve, multibody::ChannelClass wanted);

}  // namespace flexneck::pipeline
