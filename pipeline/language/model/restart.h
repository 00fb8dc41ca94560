// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <string>
#include <vector>

#include "multibody/model/model.h"
#include "pipeline/language/document/study_document.h"

namespace flexneck::pipeline {

inline constexpr std::array<Key, 2> kRestartKeys = {{
    Key::file("file", kRequired,
              "History file of a run with the same bodies, written with states = true"),
    Key::quantity("time", "s", kRequired, "Output time of that history at which this run starts",
                  {.range = at_least(0)}),
}};

/// Gives the bodies of a model the state of an output of a history, and the model its time, by the
/// keys kRestartKeys. Bodies with other masses are reported in `warnings`.
/// @throws InputError if the history has no states, other bodies or modes, or no such output.
void read_restart(const StudyTable& table, multibody::Model& model,
                  std::vector<std::string>& warnings);

}  // namespace flexneck::pipeline
