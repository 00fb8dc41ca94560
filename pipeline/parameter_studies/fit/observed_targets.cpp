// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/parameter_studies/fit/observed_targets.h"

#include "geometry/foundation/error.h"
#include "pipeline/parameter_studies/fit/curve_terms.h"

namespace flexneck::pipeline {

using Eigen::Index;
using Eigen::VectorXd;

void ObservedTargets::add(const FitTarget& target, const OutputName& output, Index first,
                          Index count) {
  targets_.push_back(&target);
  (target.curve ? wanted_.curves : wanted_.figures).push_back(output);
  for (Index k = 0; k < count; ++k) rows_.push_back(first + k);
}

VectorXd ObservedTargets::observables(Evaluator& evaluator,
                                      const std::vector<std::string>& settings) const {
  const Evaluation found = evaluator.evaluate(settings, wanted_);
  if (!found.problem.empty()) throw ComputationError(found.problem);
  VectorXd values(static_cast<Index>(rows_.size()));
  Index next = 0;
  Index figure = 0;
  std::size_t place = 0;  // row within a curve
  for (const FitTarget* const target : targets_) {
    if (!target->curve) {
      values[next++] = found.figures[figure++];
      continue;
    }
    const FitCurve& wanted = *target->curve;
    const VectorXd of_curve =
        observables_of_curve(wanted, {wanted.output, "", unit_of_curve(wanted_.curves[place]),
                                      found.times_s[place], found.curves[place]});
    values.segment(next, of_curve.size()) = of_curve;
    next += of_curve.size();
    ++place;
  }
  return values;
}

}  // namespace flexneck::pipeline
