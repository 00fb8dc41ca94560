// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/parameter_studies/fit/curve_terms.h"

#include "multibody/numerics/time_table.h"
#include "pipeline/laboratory/rating/cora.h"
#include "pipeline/laboratory/rating/iso18571.h"
#include "pipeline/laboratory/rating/resampling.h"
#include "pipeline/language/model/model_sections.h"
#include "pipeline/parameter_studies/fit/target_terms.h"

namespace flexneck::pipeline {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

VectorXd at_times(const Curve& curve, const VectorXd& times_s) {
  const multibody::TimeTable table({curve.time_s.begin(), curve.time_s.end()},
                                   {curve.values.begin(), curve.values.end()},
                                   multibody::TimeTable::Outside::constant);
  return times_s.unaryExpr([&](double time_s) { return table.value(time_s); });
}

/// Values of a target's curve at its points, SI.
VectorXd wanted_values(const FitTarget& target, const Curve& curve, const std::string& si_unit) {
  return at_key(target.table, "curve",
                [&] { return at_times(in_unit(curve, si_unit), times_of_points(*target.curve)); });
}

std::vector<FitTerm> terms_of_values(const FitTarget& target, const std::string& si_unit) {
  const double deviation =
      number_of(target, "standard_deviation", target.standard_deviation, si_unit);
  if (!(deviation > 0)) target.table.refuse("standard_deviation", "expected a positive value");
  std::vector<FitTerm> terms;
  for (const double value : wanted_values(target, target.curve->target, si_unit))
    terms.push_back({target.name, value, deviation, {}, target.is_held_out});
  return terms;
}

std::vector<FitTerm> terms_of_corridor(const FitTarget& target, const std::string& si_unit) {
  const VectorXd lower = wanted_values(target, target.curve->corridor->lower, si_unit);
  const VectorXd upper = wanted_values(target, target.curve->corridor->upper, si_unit);
  std::vector<FitTerm> terms;
  for (Index k = 0; k < lower.size(); ++k)
    terms.push_back(window_term(target, {lower[k], upper[k]}, si_unit));
  return terms;
}

double rating_of(const FitCurve& wanted, const Curve& computed) {
  const ResampledPair pair = resampled(wanted.target, computed, {wanted.from_s, wanted.to_s});
  return *wanted.rating == 0 ? rate_iso18571(pair.reference, pair.computed).overall
                             : rate_cora(pair.reference, pair.computed).overall;
}

}  // namespace

VectorXd times_of_points(const FitCurve& wanted) {
  return VectorXd::LinSpaced(wanted.points, wanted.from_s, wanted.to_s);
}

VectorXd observables_of_curve(const FitCurve& wanted, const Curve& computed) {
  if (!wanted.rating) return at_times(computed, times_of_points(wanted));
  return VectorXd::Constant(1, rating_of(wanted, in_unit(computed, wanted.target.unit)));
}

std::vector<FitTerm> curve_terms(const FitTarget& target, const std::string& si_unit) {
  if (target.curve->corridor) return terms_of_corridor(target, si_unit);
  if (!target.curve->rating) return terms_of_values(target, si_unit);
  // Throws if the curve's unit is wrong.
  static_cast<void>(wanted_values(target, target.curve->target, si_unit));
  return {target.is_window() ? window_term(target, "1") : value_term(target, "1")};
}

}  // namespace flexneck::pipeline
