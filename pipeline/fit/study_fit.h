// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "pipeline/evaluation/evaluator.h"
#include "pipeline/fit/fit_objective.h"
#include "pipeline/fit/observed_targets.h"
#include "pipeline/fit/parameter_expressions.h"
#include "pipeline/sampling/varied_key.h"
#include "pipeline/study/fit_section.h"

namespace flexneck::pipeline {

/// A target as people read it.
struct ShownTarget {
  std::string name;
  std::string output;
  std::string unit;   ///< that the study gave it in; "1" for a pure number
  double factor = 1;  ///< from SI to that
  std::string wanted;
  Origin origin = Origin::synthetic;
};

/// The fit of a study: its targets as terms, its free keys as parameters, its results as the model.
/// Observables are figures in SI units, of a curve its values at the points as which it counts, or
/// its rating.
class StudyFit {
 public:
  /// Finds outputs, units and the start, and refuses what cannot be fitted.
  /// @param evaluator  outlives this
  /// @param threads    that evaluate the model for one slope
  /// @throws InputError with file and key, as Evaluator::wanted(), require_produced() and
  /// check_varied() do, too.
  StudyFit(Evaluator& evaluator, FitSection section, unsigned threads);
  StudyFit(const StudyFit&) = delete;
  StudyFit& operator=(const StudyFit&) = delete;

  const FitSection& section() const { return section_; }
  const Evaluator& evaluator() const { return evaluator_; }
  const FitObjective& objective() const { return *objective_; }
  /// One for each target of the section, in its order.
  const std::vector<ShownTarget>& targets() const { return targets_; }
  /// Where the first fit begins, in the unit cube.
  const Eigen::VectorXd& start() const { return start_; }

  /// "key=value" for each parameter.
  std::vector<std::string> settings(const Eigen::VectorXd& parameters) const;
  /// The study with these values. @throws InputError as read_study() does.
  Study study(const Eigen::VectorXd& parameters) { return evaluator_.study(settings(parameters)); }
  /// Whether the study with these values is one that can be read, such as of a neck whose parts
  /// fit.
  bool is_accepted(const Eigen::VectorXd& parameters);
  /// Observables without slopes. @throws InputError or ComputationError where there are none.
  Eigen::VectorXd observables(const Eigen::VectorXd& parameters);
  /// How slopes are found: "in closed form", those of targets of the modes alone; "by differences",
  /// or some so and some so.
  std::string slopes_text() const;
  void start_solvers() { evaluator_.start(); }

 private:
  VariedKey varied(std::size_t parameter) const;
  std::vector<FitRange> ranges() const;
  void find_start();
  void check_parameters() const;
  /// Of all targets, and the outputs they need.
  std::vector<FitTerm> terms();
  void add_figure_terms(const FitTarget& target, std::vector<FitTerm>& terms);
  void add_curve_terms(const FitTarget& target, std::vector<FitTerm>& terms);
  void add_expression_term(const FitTarget& target, std::vector<FitTerm>& terms);
  /// @param first  row of its observables, that of its first term
  void add_observed(const FitTarget& target, const OutputName& output, std::size_t first,
                    std::size_t count);

  using Moved = std::vector<std::pair<std::vector<std::string>, double>>;
  /// Settings with each parameter moved a little, and by how much.
  /// @param direction  1 or -1; the other one at a bound
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
  ObservedTargets others_;    ///< that are fitted
  ParameterExpressions expressions_;
  std::vector<ShownTarget> targets_;
  std::optional<FitObjective> objective_;
  std::function<ModelSlopes(const Eigen::VectorXd&)> differences_;
  std::function<ModelSlopes(const Eigen::VectorXd&)> differences_of_others_;
  std::function<ModelSlopes(const Eigen::VectorXd&)> differences_of_expressions_;
  Eigen::VectorXd start_;
  bool has_closed_slopes_ = false;  ///< of the modes

  std::mutex mutex_;
  /// Closed slopes of the modes at the last few places: a fit asks for a place's values first, for
  /// which all of the solution is needed already.
  std::vector<std::pair<Eigen::VectorXd, ModelSlopes>> known_;
};

}  // namespace flexneck::pipeline
