// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "pipeline/laboratory/curve_file.h"
#include "pipeline/language/document/study_document.h"

namespace flexneck::pipeline {

/// A corridor of a curve: a lower and an upper curve at the same times and in the same unit, linear
/// between these.
struct CurveCorridor {
  Curve lower, upper;
};

/// Keys of a corridor in several sections of a study.
inline constexpr auto kCorridorKeys = std::to_array<Key>({
    Key::file("table", kNone,
              "CSV file with the columns \"lower\" and \"upper\", instead of the keys times, lower "
              "and upper"),
    Key::quantities("times", "s", kNone, "Times of the corridor's points; linear in between"),
    Key::numbers("lower", kNone, "Lower limit at each time"),
    Key::numbers("upper", kNone, "Upper limit at each time"),
    Key::text("unit", kNone, "Unit of the values, if no file gives it"),
});

/// Reads a corridor. Its file, if there is one, is recorded by FilesRead.
/// @throws InputError with file, line and key, also if the lower curve exceeds the upper one.
CurveCorridor read_corridor(const StudyTable& table);

}  // namespace flexneck::pipeline
