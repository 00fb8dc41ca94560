// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/parameter_studies/fit/parameter_expressions.h"

#include <cmath>

#include "geometry/foundation/error.h"
#include "pipeline/language/document/product_text.h"
#include "pipeline/language/model/expression.h"

namespace flexneck::pipeline {

using Eigen::Index;
using Eigen::VectorXd;

ParameterExpressions::ParameterExpressions(std::vector<std::string> parameters) {
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    if (!is_variable_name(parameters[k])) continue;
    names_.push_back(std::move(parameters[k]));
    places_.push_back(static_cast<Index>(k));
  }
}

void ParameterExpressions::add(const std::string& text, Index row) {
  try {
    static_cast<void>(Expression(text, names_));
  } catch (const InputError& error) {
    std::string named;
    for (const std::string& each : names_) named += (named.empty() ? "" : ", ") + each;
    throw InputError(std::string(error.what()) + "; parameters whose names are single words: " +
                     (named.empty() ? "none" : named));
  }
  texts_.push_back(text);
  rows_.push_back(row);
}

VectorXd ParameterExpressions::values(const VectorXd& parameters) const {
  const VectorXd named = parameters(places_);
  VectorXd values(static_cast<Index>(texts_.size()));
  for (std::size_t k = 0; k < texts_.size(); ++k) {
    // Parsed anew, since a parsed expression holds its variables, and threads share this object.
    const double value = Expression(texts_[k], names_)({named.data(), names_.size()});
    if (!std::isfinite(value))
      throw ComputationError("\"" + texts_[k] + "\" is no number for these parameters");
    values[static_cast<Index>(k)] = value;
  }
  return values;
}

}  // namespace flexneck::pipeline
