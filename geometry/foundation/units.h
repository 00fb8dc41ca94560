// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

namespace flexneck {

inline constexpr double kStandardGravity_m_s2 = 9.80665;  ///< the unit "gn"

/// Value in SI units of a number with its unit, such as "0.4 in", "1.2 kpsi" or "0.1408
/// lbf*s^2*in". `si_unit` is the SI unit of the expected dimension, e.g. "m", "Pa", "kg/m^3",
/// "kg*m^2", "rad". "lb" is a mass, "lbf" a force; "gn" is the standard acceleration of gravity,
/// and so is "g" alone where an acceleration is expected; elsewhere "g" is the gram.
/// @throws InputError if the text has no number or unit, an unknown unit or another dimension. The
/// message does not name the key: the caller knows it and puts it in front.
double parse_quantity(std::string_view text, std::string_view si_unit);

/// Factor that turns a value in `si_unit` into one in `unit`: 39.37… for ("m", "in").
/// @throws InputError if the units are unknown or of different dimension.
double factor_from_si(std::string_view si_unit, std::string_view unit);

}  // namespace flexneck
