// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

namespace flexneck::pipeline {

/// A unit as it is written in text: "lbf·ft", "kg·m²", "g" for an acceleration.
std::string unit_label(const std::string& unit);

/// Display of a unit in the page's two systems: {"customary": {"name", "factor"}, "metric":
/// {"name", "factor"}}, US customary units and SI with mm, deg, ms, kN and g. Null for a unit that
/// both leave unchanged, such as Hz.
nlohmann::ordered_json display_unit(const std::string& unit);

/// Display with a customary unit other than the default, such as "in*lbf" instead of "lbf*ft".
nlohmann::ordered_json display_unit(const std::string& unit, const std::string& customary);

/// Displays of all units, keyed by unit.
nlohmann::ordered_json display_units();

}  // namespace flexneck::pipeline
