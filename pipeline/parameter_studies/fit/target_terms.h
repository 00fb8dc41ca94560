// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <utility>

#include "pipeline/language/study/fit_section.h"
#include "pipeline/language/study/study.h"
#include "pipeline/parameter_studies/fit/fit_objective.h"

namespace flexneck::pipeline {

/// Value in SI of a target's text such as "36.1 Hz"; a pure number if the unit is "1".
/// @throws InputError with file, line and key.
double number_of(const FitTarget& target, const char* key, const std::string& text,
                 const std::string& si_unit);

/// The text that contains the target's unit; empty for a corridor.
const std::string& text_with_unit(const FitTarget& target);

/// Unit of such a text, and the factor to it from SI.
std::pair<std::string, double> unit_of_text(const std::string& text, const std::string& si_unit);

/// Terms of targets: a window from the target's keys, a window of a corridor, and a value. @throws
/// InputError as number_of() does, for a window whose lower edge exceeds the upper one and for
/// deviations that are not positive.
FitTerm window_term(const FitTarget& target, const std::string& si_unit);
FitTerm window_term(const FitTarget& target, const FitTerm::Window& window,
                    const std::string& si_unit);
FitTerm value_term(const FitTarget& target, const std::string& si_unit);

/// Text such as "36.1 Hz +- 0.3 %", "50 ms to 60 ms", "curve.csv +- 1 deg", "corridor.csv".
std::string wanted_text(const FitTarget& target);

/// Origin of a target's value by the study.
Origin origin_of(const Study& study, const FitTarget& target);

}  // namespace flexneck::pipeline
