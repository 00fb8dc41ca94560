// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/laboratory/curve_file.h"
#include "pipeline/language/document/channel_class.h"
#include "pipeline/language/document/study_document.h"

namespace flexneck::pipeline {

// A curve of a file in several sections of a study: the key "table" and the following keys.

constexpr Key curve_file_key(std::string_view fallback) {
  return Key::file(
      "table", fallback,
      "CSV file with a header such as \"time [ms],angle [deg]\", or with two columns without a "
      "header; or an ISO-MME test: its folder, its .mme file or the file of a channel");
}

inline constexpr auto kCurveTableKeys = std::to_array<Key>({
    Key::text("column", kNone,
              "Column of that file, if it has more than two; channel code of an ISO-MME test"),
    Key::text("unit", kNone, "Unit of the values, if the file gives none"),
    Key::text("filter", kNone,
              "Channel frequency class with which the values are filtered, unless their ISO-MME "
              "code says that they are filtered already (default: no filter)",
              {.choices = channel_class_names}),
    Key::quantity("time_zero", "s", "0", "Time in the file that is time zero of the case"),
});

/// Reads the curve over the time of the case, filtered as asked, in the file's unit. Its file is
/// recorded by FilesRead.
/// @throws InputError with file, line and key, or as read_curve() does.
Curve read_curve_table(const StudyTable& table);

/// Reads a column of the file unfiltered, by "table" and "unit" alone.
Curve read_curve_column(const StudyTable& table, const std::string& column);

}  // namespace flexneck::pipeline
