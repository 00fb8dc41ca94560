// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

namespace flexneck::pipeline {

/// Targets that are expressions of the parameters, for which no model runs: inequalities between
/// parameters, or what is known of their ratio.
class ParameterExpressions {
 public:
  /// @param parameters  their names, in order
  explicit ParameterExpressions(std::vector<std::string> parameters);

  /// @param row  of its value among the observables of all targets
  /// @throws InputError for a text that cannot be read, with the parameters that one may name.
  void add(const std::string& text, Eigen::Index row);

  const std::vector<Eigen::Index>& rows() const { return rows_; }
  /// @param parameters  each in its own unit
  /// @throws ComputationError for one that is no finite number there.
  Eigen::VectorXd values(const Eigen::VectorXd& parameters) const;

 private:
  std::vector<std::string> names_;
  std::vector<Eigen::Index> places_;  ///< of the names among the parameters
  std::vector<std::string> texts_;
  std::vector<Eigen::Index> rows_;
};

}  // namespace flexneck::pipeline
