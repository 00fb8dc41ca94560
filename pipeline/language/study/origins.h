// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "pipeline/language/study/study.h"

namespace flexneck::pipeline {

/// Origins of values by the study, as text: "published", or "published and inferred" if they
/// differ. Empty if none of the keys is present.
/// @param table  table such as "pulse.flexion"; empty for the root
/// @param keys  keys of that table; empty for all but its name
std::string origins_of(const std::vector<Parameter>& parameters, const std::string& table,
                       const std::vector<std::string>& keys = {});

/// Origins of the pulses that cases use, in the study's order: "'flexion' synthetic, 'mine'
/// published".
std::string pulse_origins(const Study& study);

/// Pulses that cases of the study use, in its order.
std::vector<const PulseSection*> pulses_in_use(const Study& study);

}  // namespace flexneck::pipeline
