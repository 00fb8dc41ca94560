// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "pipeline/study/study.h"

namespace flexneck::pipeline {

/// What a study says of where values come from, for texts about them: "published", or "published
/// and inferred" where they differ. Empty if none of the keys is there.
/// @param table  such as "pulse.flexion"; empty for the root
/// @param keys  of that table; empty for all but its name
std::string origins_of(const std::vector<Parameter>& parameters, const std::string& table,
                       const std::vector<std::string>& keys = {});

/// "'flexion' synthetic, 'mine' published": of the pulses that cases use, in the study's order.
std::string pulse_origins(const Study& study);

/// Pulses that cases of the study use, in its order.
std::vector<const PulseSection*> pulses_in_use(const Study& study);

}  // namespace flexneck::pipeline
