// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/laboratory/verdict/judged_figure.h"

#include <cmath>
#include <utility>

#include <fmt/core.h>

#include "geometry/foundation/units.h"

namespace flexneck::pipeline {

namespace {

struct ShownUnit {
  std::string name;
  int digits = 1;
};

ShownUnit shown_unit(const JudgedFigure& figure, const CertificationTest& test) {
  if (figure.unit == "rad") return {"deg", 1};
  if (figure.unit == "s") return {"ms", 1};
  if (figure.unit == "m/s^2") return {"gn", 2};
  if (figure.unit == "m/s") return {test.velocity_unit, 2};
  return {test.moment_unit, 1};
}

/// Numbers of a figure in its display unit.
class Shown {
 public:
  Shown(const JudgedFigure& figure, const CertificationTest& test)
      : unit_(shown_unit(figure, test)), factor_(factor_from_si(figure.unit, unit_.name)) {}

  std::string operator()(double value) const {
    return fmt::format("{:.{}f}", value * factor_, unit_.digits);
  }
  const std::string& unit() const { return unit_.name; }

 private:
  ShownUnit unit_;
  double factor_;
};

std::string limits_text(const Limits& limits, const Shown& shown) {
  if (std::isinf(limits.low)) return "at most " + shown(limits.high);
  if (std::isinf(limits.high)) return "at least " + shown(limits.low);
  return shown(limits.low) + " to " + shown(limits.high);
}

}  // namespace

JudgedFigure judged_figure(std::string name, const char* unit, const Limits& limits,
                           std::optional<double> value, const std::string& problem) {
  return {std::move(name), unit, limits, value, value ? "" : problem};
}

std::optional<double> JudgedFigure::half_corridors() const {
  const double half = (limits.high - limits.low) / 2;
  if (!value || std::isinf(half)) return {};
  return (*value - limits.low) / half - 1;
}

FigureText text_of(const JudgedFigure& figure, const CertificationTest& test) {
  const Shown shown(figure, test);
  FigureText text;
  text.value = figure.value ? shown(*figure.value) : "-";
  text.limits = limits_text(figure.limits, shown);
  text.unit = shown.unit();
  const std::optional<double> distance = figure.half_corridors();
  text.distance = distance       ? fmt::format("{:+.2f}", *distance)
                  : figure.value ? "-"
                                 : figure.problem;
  return text;
}

std::string outside_text(const JudgedFigure& figure, const CertificationTest& test) {
  if (!figure.value) return figure.name + ": " + figure.problem;
  const Shown shown(figure, test);
  const bool is_above = *figure.value > figure.limits.high;
  const double by =
      is_above ? *figure.value - figure.limits.high : figure.limits.low - *figure.value;
  return fmt::format("{}: {} {}, {} {} {} {} {}", figure.name, shown(*figure.value), shown.unit(),
                     shown(by), shown.unit(), is_above ? "above" : "below",
                     limits_text(figure.limits, shown), shown.unit());
}

}  // namespace flexneck::pipeline
