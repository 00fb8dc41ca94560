// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "pipeline/language/study/fit_section.h"
#include "pipeline/parameter_studies/evaluation/evaluator.h"
#include "pipeline/parameter_studies/fit/fit_objective.h"
#include "pipeline/parameter_studies/fit/observed_targets.h"
#include "pipeline/parameter_studies/fit/parameter_expressions.h"
#include "pipeline/parameter_studies/sampling/varied_key.h"

namespace flexneck::pipeline {

/// A target with its text for readers.
struct ShownTarget {
  std::string name;
  std::string output;
  std::string unit;   ///< unit in which the study gives it; "1" for a pure number
  double factor = 1;  ///< factor from SI to that unit
  std::string wanted;
  Origin origin = Origin::synthetic;
};

/// The fit of a study: its targets as terms, its free keys as parameters, its results as the model.
/// Observables are figures in SI units, for a curve its values at the points at which it is
/// compared, or its rating.
class StudyFit {
 public:
  /// Finds outputs, units and the start; fails for a study that cannot be fitted.
  /// @param evaluator  outlives this
  /// @param threads    number of threads that evaluate the model for one slope
  /// @throws InputError with file and key, also as Evaluator::wanted(), require_produced() and
  /// check_varied() do.
  StudyFit(Evaluator& evaluator, FitSection section, unsigned threads);
  StudyFit(const StudyFit&) = delete;
  StudyFit& operator=(const StudyFit&) = delete;

  const FitSection& section() const { return section_; }
  const Evaluator& evaluator() const { return evaluator_; }
  const FitObjective& objective() const { return *objective_; }
  /// Shown targets, one for each target of the section, in its order.
  const std::vector<ShownTarget>& targets() const { return targets_; }
  /// Start of the first fit, in the unit cube.
  const Eigen::VectorXd& start() const { return start_; }

  /// Settings "key=value", one for each parameter.
  std::vector<std::string> settings(const Eigen::VectorXd& parameters) const;
  /// Reads the study with these values. @throws InputError as read_study() does.
  Study study(const Eigen::VectorXd& parameters) { return evaluator_.study(settings(parameters)); }
  /// Returns whether the study with these values is valid; it is not if, say, the neck's parts do
  /// not fit.
  bool is_accepted(const Eigen::VectorXd& parameters);
  /// Computes observables without slopes. @throws InputError or ComputationError if the model
  /// fails.
  Eigen::VectorXd observables(const Eigen::VectorXd& parameters);
  /// Text on the derivatives: "in closed form" if all targets are of the modes; "by differences";
  /// or a mixture.
  std::string slopes_text() const;
  void start_solvers() { evaluator_.start(); }

 private:
  VariedKey varied(std::size_t parameter) const;
  std::vector<FitRange> ranges() const;
  void find_start();
  void check_parameters() const;
  /// Terms of all targets; collects the outputs that they need.
  std::vector<FitTerm> terms();
  void add_figure_terms(const FitTarget& target, std::vector<FitTerm>& terms);
  void add_curve_terms(const FitTarget& target, std::vector<FitTerm>& terms);
  void add_expression_term(const FitTarget& target, std::vector<FitTerm>& terms);
  /// @param first  row of its first observable, which is that of its first term
  void add_observed(const FitTarget& target, const OutputName& output, std::size_t first,
                    std::size_t count);

  using Moved = std::vector<std::pair<std::vector<std::string>, double>>;
  /// Settings with each parameter slightly changed, and the changes.
  /// @param direction  1 or -1; reversed at a bound
  Moved moved(const Eigen::VectorXd& parameters, double direction) const;
  void look_for_closed_slopes();
  void check_produced();
  std::optional<ModelSlopes> closed_slopes(const Eigen::VectorXd& parameters);
  ModelSlopes slopes(const Eigen::VectorXd& parameters);
  Eigen::VectorXd values(const Eigen::VectorXd& parameters);

  Evaluator& evaluator_;
  FitSection section_;
  ObservedTargets all_;
  ObservedTargets of_modes_;  ///< figures of the modes, which may have closed slopes
  ObservedTargets others_;    ///< fitted targets of other outputs
  ParameterExpressions expressions_;
  std::vector<ShownTarget> targets_;
  std::optional<FitObjective> objective_;
  std::function<ModelSlopes(const Eigen::VectorXd&)> differences_;
  std::function<ModelSlopes(const Eigen::VectorXd&)> differences_of_others_;
  std::function<ModelSlopes(const Eigen::VectorXd&)> differences_of_expressions_;
  Eigen::VectorXd start_;
  bool has_closed_slopes_ = false;  ///< for the targets of the modes

  std::mutex mutex_;
  /// Closed slopes of the modes at the last few places: a fit asks for the values at a place first,
  /// which already need the whole solution.
  std::vector<std::pair<Eigen::VectorXd, ModelSlopes>> known_;
};

}  // namespace flexneck::pipeline
