// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/laboratory/verdict/verdict.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace flexneck::pipeline {

namespace {

double distance_of(const JudgedFigure& figure) {
  return std::abs(figure.half_corridors().value_or(std::numeric_limits<double>::infinity()));
}

}  // namespace

bool Verdict::passed() const { return passed_count() == figures.size(); }

std::size_t Verdict::passed_count() const {
  return static_cast<std::size_t>(
      std::count_if(figures.begin(), figures.end(),
                    [](const JudgedFigure& figure) { return figure.is_inside(); }));
}

const JudgedFigure& Verdict::furthest() const {
  return *std::max_element(
      figures.begin(), figures.end(),
      [](const JudgedFigure& a, const JudgedFigure& b) { return distance_of(a) < distance_of(b); });
}

std::vector<JudgedFigure> Verdict::unmet_conditions() const {
  std::vector<JudgedFigure> unmet;
  std::copy_if(conditions.begin(), conditions.end(), std::back_inserter(unmet),
               [](const JudgedFigure& figure) { return !figure.is_inside(); });
  return unmet;
}

Verdict judged(const CertificationTest& test, const TestCurves& curves) {
  return {judged_response(test, curves.response),
          judged_conditions(test, curves.impact_velocity_m_s, curves.pulse)};
}

}  // namespace flexneck::pipeline
