// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

namespace flexneck::pipeline {

/// A unit as people write it: "lbf·ft", "kg·m²", "g" of an acceleration.
std::string unit_label(const std::string& unit);

/// What a unit is shown as in the page's two systems: {"customary": {"name", "factor"}, "metric":
/// {"name", "factor"}}, US customary units and SI with mm, deg, ms, kN and g. Null for one that
/// both show as it is, such as Hz.
nlohmann::ordered_json display_unit(const std::string& unit);

/// The same with a customary unit of one's own, such as "in*lbf" where the table has "lbf*ft".
nlohmann::ordered_json display_unit(const std::string& unit, const std::string& customary);

/// All of them, by unit.
nlohmann::ordered_json display_units();

}  // namespace flexneck::pipeline
