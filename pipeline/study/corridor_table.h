// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "pipeline/document/curve_file.h"
#include "pipeline/document/study_document.h"

namespace flexneck::pipeline {

/// Where a curve should run: a lower and an upper one at the same times and in the same unit,
/// linear between these.
struct CurveCorridor {
  Curve lower, upper;
};

/// As several sections of a study name it.
inline constexpr auto kCorridorKeys = std::to_array<Key>({
    Key::file("table", kNone,
              "CSV file with the columns \"lower\" and \"upper\"; in place of times, lower, upper"),
    Key::quantities("times", "s", kNone, "Times of the corridor, linear between them"),
    Key::numbers("lower", kNone, "Least value at each time"),
    Key::numbers("upper", kNone, "Largest value at each time"),
    Key::text("unit", kNone, "Unit of the values, where no file names it"),
});

/// Its file, if there is one, is appended to `files`.
/// @throws InputError with file, line and key, also for a corridor that crosses itself.
CurveCorridor read_corridor(const StudyTable& table);

}  // namespace flexneck::pipeline
