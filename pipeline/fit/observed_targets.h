// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "pipeline/evaluation/evaluator.h"
#include "pipeline/study/fit_section.h"

namespace flexneck::pipeline {

/// Some targets of a fit with the outputs that they are read off.
class ObservedTargets {
 public:
  /// @param target  outlives this
  /// @param first   of its observables among those of all targets
  /// @param count   of them
  void add(const FitTarget& target, const OutputName& output, Eigen::Index first,
           Eigen::Index count);

  bool is_empty() const { return targets_.empty(); }
  const WantedOutputs& wanted() const { return wanted_; }
  /// Where their observables are among those of all targets.
  const std::vector<Eigen::Index>& rows() const { return rows_; }

  /// SI; of a curve its values at its points, or its rating.
  /// @throws as Evaluator::evaluate() does, and ComputationError for a figure that there is not.
  Eigen::VectorXd observables(Evaluator& evaluator, const std::vector<std::string>& settings) const;

 private:
  std::vector<const FitTarget*> targets_;
  WantedOutputs wanted_;
  std::vector<Eigen::Index> rows_;
};

}  // namespace flexneck::pipeline
