// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include <Eigen/Core>

#include "multibody/signals/cfc_filter.h"
#include "pipeline/iso_mme/channel_code.h"

namespace flexneck::pipeline {

/// A column of a CSV file over its first one, the time, or a channel of an ISO-MME test.
struct Curve {
  std::string file;                   ///< as it was named
  std::string column;                 ///< its name or code; empty if the file has no line of names
  std::string unit;                   ///< of the values; empty if the file names none
  Eigen::VectorXd time_s;             ///< shape (n), n > 1, strictly increasing
  Eigen::VectorXd values;             ///< shape (n), in that unit, finite
  std::filesystem::path source = {};  ///< the file that holds it: of a test, the channel's
  std::optional<MmeFilter> filter = {};  ///< that its code says it has passed; CSV does not tell

  /// "file: 'column' [unit]" as far as there are such.
  std::string label() const;
};

/// Reads a file as flexneck writes it, its first line with "time [ms],name [unit],…", or one of two
/// columns without such a line: seconds and values whose unit is not known; or a channel of what
/// names a test of ISO-MME (iso_mme/test_folder.h).
/// @param column  by name, or by its code of ISO-MME; may be empty if there is one only
/// @throws InputError with file and line for what is not such a file, a column that is not there,
/// times that do not increase and what is not a finite number; and as read_mme_channel() does.
Curve read_curve(const std::filesystem::path& path, const std::string& column);

/// The curve in another unit.
/// @throws InputError with the file and the column for a unit of another dimension.
Curve in_unit(Curve curve, const std::string& unit);

/// Whether a curve is to be filtered for a class to be its own: not if its ISO-MME code says that
/// it has passed the class already; a second time would narrow it. What has passed a wider one is
/// filtered as what has passed none, as SAE J211 does.
/// @throws InputError for a curve that has passed a narrower class, or what is no class: it cannot
/// be had any more.
bool needs_filter(const Curve& curve, multibody::ChannelClass wanted);

}  // namespace flexneck::pipeline
