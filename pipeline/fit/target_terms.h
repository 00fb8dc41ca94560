// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <utility>

#include "pipeline/fit/fit_objective.h"
#include "pipeline/study/fit_section.h"
#include "pipeline/study/study.h"

namespace flexneck::pipeline {

/// A text of a target such as "36.1 Hz" in SI; a pure number where the unit is "1".
/// @throws InputError with file, line and key.
double number_of(const FitTarget& target, const char* key, const std::string& text,
                 const std::string& si_unit);

/// The unit of such a text, and the factor to it from SI.
std::pair<std::string, double> unit_of_text(const std::string& text, const std::string& si_unit);

/// A target that is a window, and one that is a value. @throws InputError as number_of() does, for
/// a window that crosses itself and for deviations that are not positive.
FitTerm window_term(const FitTarget& target, const std::string& si_unit);
FitTerm value_term(const FitTarget& target, const std::string& si_unit);

/// "36.1 Hz +- 0.3 %", "50 ms to 60 ms"
std::string wanted_text(const FitTarget& target);

/// The rating of a computed curve, of the target's unit, against it. @pre wanted.rating
/// @throws InputError as resampled() and the ratings do.
double rating_of(const FitCurve& wanted, const Curve& computed);

/// Where a target's value comes from, as the study says.
Origin origin_of(const Study& study, const FitTarget& target);

}  // namespace flexneck::pipeline
