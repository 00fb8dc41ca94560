// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/parameter_studies/fit/target_terms.h"

#include <cmath>

#include <fmt/core.h>

#include "geometry/foundation/error.h"
#include "geometry/foundation/units.h"
#include "pipeline/language/document/product_text.h"

namespace flexneck::pipeline {

/// Value in SI of a text such as "36.1 Hz"; a pure number if the output is one.
double number_of(const FitTarget& target, const char* key, const std::string& text,
                 const std::string& si_unit) {
  try {
    if (si_unit != "1") return parse_quantity(text, si_unit);
    const ProductText product = parse_product(text);
    if (!product.names.empty() || !product.unit.empty())
      throw InputError("expected a pure number, found \"" + text + "\"");
    return product.number;
  } catch (const InputError& error) {
    target.table.refuse(key, error.what());
  }
}

/// Unit of such a text, and the factor to it from SI.
std::pair<std::string, double> unit_of_text(const std::string& text, const std::string& si_unit) {
  if (si_unit == "1") return {"1", 1};
  const std::string unit = parse_product(text).unit;
  return {unit, factor_from_si(si_unit, unit)};
}

FitTerm window_term(const FitTarget& target, const FitTerm::Window& window,
                    const std::string& si_unit) {
  constexpr double kShare = 0.1;
  const double smoothing = target.smoothing.empty()
                               ? kShare * (window.high - window.low)
                               : number_of(target, "smoothing", target.smoothing, si_unit);
  if (!(smoothing > 0))
    target.table.refuse("smoothing",
                        target.smoothing.empty()
                            ? "expected this key, since the corridor has no width at some point"
                            : "expected a positive value");
  return {target.name, 0, smoothing, window, target.is_held_out, target.must_hold};
}

FitTerm window_term(const FitTarget& target, const std::string& si_unit) {
  FitTerm::Window window;
  if (!target.low.empty()) window.low = number_of(target, "low", target.low, si_unit);
  if (!target.high.empty()) window.high = number_of(target, "high", target.high, si_unit);
  if (!(window.low < window.high)) target.table.refuse("high", "expected a value above low");
  return window_term(target, window, si_unit);
}

FitTerm value_term(const FitTarget& target, const std::string& si_unit) {
  const double value = number_of(target, "value", target.value, si_unit);
  const double deviation =
      target.relative_deviation
          ? *target.relative_deviation * std::abs(value)
          : number_of(target, "standard_deviation", target.standard_deviation, si_unit);
  if (!(deviation > 0))
    target.table.refuse(target.relative_deviation ? "relative_deviation" : "standard_deviation",
                        "expected a positive deviation");
  return {target.name, value, deviation, {}, target.is_held_out};
}

const std::string& text_with_unit(const FitTarget& target) {
  for (const std::string* const text : {&target.value, &target.low, &target.high})
    if (!text->empty()) return *text;
  return target.standard_deviation;
}

std::string wanted_text(const FitTarget& target) {
  if (target.curve && target.curve->corridor) {
    const std::string& file = target.curve->corridor->lower.file;
    return file.empty() ? "a corridor" : std::filesystem::path(file).filename().string();
  }
  if (target.curve && !target.curve->rating)
    return std::filesystem::path(target.curve->target.file).filename().string() + " +- " +
           target.standard_deviation;
  if (target.is_window())
    return (target.low.empty()    ? "below " + target.high
            : target.high.empty() ? "above " + target.low
                                  : target.low + " to " + target.high);
  return target.value + (target.relative_deviation
                             ? fmt::format(" +- {:g} %", 100 * *target.relative_deviation)
                             : " +- " + target.standard_deviation);
}

Origin origin_of(const Study& study, const FitTarget& target) {
  const std::string path = "fit.target." + target.table.text("name") + ".";
  for (const Parameter& each : study.parameters)
    if (each.key == path + "value" || each.key == path + "low" || each.key == path + "high" ||
        each.key == path + "table" || each.key.starts_with(path + "corridor."))
      return each.origin;
  return Origin::synthetic;
}

}  // namespace flexneck::pipeline
