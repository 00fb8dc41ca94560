// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/foundation/units.h"

#include <charconv>
#include <cmath>
#include <memory>
#include <string>

#include <udunits2.h>

#include "geometry/foundation/error.h"

namespace flexneck {

namespace {

using UnitSystem = std::unique_ptr<ut_system, decltype(&ut_free_system)>;
using Unit = std::unique_ptr<ut_unit, decltype(&ut_free)>;
using Converter = std::unique_ptr<cv_converter, decltype(&cv_free)>;

/// Reading the unit database takes milliseconds, so it is read once; it never changes afterwards.
const ut_system& unit_system() {
  static const UnitSystem system = [] {
    ut_set_error_message_handler(ut_ignore);
    UnitSystem fresh(ut_read_xml(nullptr), ut_free_system);
    if (!fresh) throw ComputationError("the unit database of UDUNITS-2 cannot be read");
    // The database knows these units only by longer names.
    const Unit gravity(ut_parse(fresh.get(), "standard_free_fall", UT_ASCII), ut_free);
    const Unit degree(ut_parse(fresh.get(), "arc_degree", UT_ASCII), ut_free);
    if (ut_map_symbol_to_unit("gn", UT_ASCII, gravity.get()) != UT_SUCCESS ||
        ut_map_symbol_to_unit("deg", UT_ASCII, degree.get()) != UT_SUCCESS) {
      throw ComputationError("the unit database of UDUNITS-2 lacks gravity or degree");
    }
    return fresh;
  }();
  return *system;
}

Unit parse_unit(std::string_view text) {
  const std::string name(text);
  Unit unit(ut_parse(&unit_system(), name.c_str(), UT_ASCII), ut_free);
  if (!unit) throw InputError("unknown unit '" + name + "'");
  return unit;
}

/// Factor between two units. An offset (as in degrees Celsius) has no place here.
double factor(std::string_view from, std::string_view to) {
  const Unit source = parse_unit(from);
  const Unit target = parse_unit(to);
  const Converter converter(ut_get_converter(source.get(), target.get()), cv_free);
  const bool angle_wanted = to == "rad" || from == "rad";
  const bool is_pure_number = ut_is_dimensionless(source.get()) != 0 && !angle_wanted;
  if (!converter || (is_pure_number && to != from)) {
    throw InputError("expected a unit such as '" + std::string(to) + "', found '" +
                     std::string(from) + "', which measures something else");
  }
  return cv_convert_double(converter.get(), 1.0) - cv_convert_double(converter.get(), 0.0);
}

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

}  // namespace

double parse_quantity(std::string_view text, std::string_view si_unit) {
  const std::string_view body = trimmed(text);
  double value = 0;
  const auto [end, error] = std::from_chars(body.data(), body.data() + body.size(), value);
  const std::string example = "\"1.5 " + std::string(si_unit) + "\"";
  if (error != std::errc() || !std::isfinite(value)) {
    throw InputError("expected a number with its unit such as " + example + ", found \"" +
                     std::string(text) + "\"");
  }
  const std::string_view unit = trimmed(body.substr(static_cast<std::size_t>(end - body.data())));
  if (unit.empty()) {
    throw InputError("expected a unit after the number, such as " + example + ", found \"" +
                     std::string(text) + "\"");
  }
  return value * factor(unit, si_unit);
}

double factor_from_si(std::string_view si_unit, std::string_view unit) {
  return factor(si_unit, unit);
}

}  // namespace flexneck
