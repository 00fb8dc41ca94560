// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "pipeline/language/study/fit_section.h"
#include "pipeline/parameter_studies/evaluation/evaluator.h"

namespace flexneck::pipeline {

/// Some targets of a fit with the outputs that give their observables.
class ObservedTargets {
 public:
  /// @param target  outlives this
  /// @param first   index of its first observable among those of all targets
  /// @param count   number of its observables
  void add(const FitTarget& target, const OutputName& output, Eigen::Index first,
           Eigen::Index count);

  bool is_empty() const { return targets_.empty(); }
  const WantedOutputs& wanted() const { return wanted_; }
  /// Indices of their observables among those of all targets.
  const std::vector<Eigen::Index>& rows() const { return rows_; }

  /// Observables in SI units; for a curve its values at its points, or its rating.
  /// @throws as Evaluator::evaluate() does, and ComputationError for a figure that is missing.
  Eigen::VectorXd observables(Evaluator& evaluator, const std::vector<std::string>& settings) const;

 private:
  std::vector<const FitTarget*> targets_;
  WantedOutputs wanted_;
  std::vector<Eigen::Index> rows_;
};

}  // namespace flexneck::pipeline
