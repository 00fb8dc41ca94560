// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

namespace flexneck::pipeline {

/// Targets that are expressions of the parameters and need no model: inequalities between
/// parameters, or known ratios.
class ParameterExpressions {
 public:
  /// @param parameters  names of the parameters, in order
  explicit ParameterExpressions(std::vector<std::string> parameters);

  /// @param row  index of its value among the observables of all targets
  /// @throws InputError for an invalid text, with the names of the parameters.
  void add(const std::string& text, Eigen::Index row);

  const std::vector<Eigen::Index>& rows() const { return rows_; }
  /// @param parameters  each in its own unit
  /// @throws ComputationError for a value that is not finite.
  Eigen::VectorXd values(const Eigen::VectorXd& parameters) const;

 private:
  std::vector<std::string> names_;
  std::vector<Eigen::Index> places_;  ///< indices of the names among the parameters
  std::vector<std::string> texts_;
  std::vector<Eigen::Index> rows_;
};

}  // namespace flexneck::pipeline
