// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/language/document/table_values.h"

#include <vector>

namespace flexneck::pipeline {

Eigen::Vector3d unit_vector(const StudyTable& table, const std::string& key) {
  const std::vector<double> numbers = table.numbers(key, 3);
  const Eigen::Vector3d vector = Eigen::Map<const Eigen::Vector3d>(numbers.data());
  if (!(vector.norm() > 0)) table.refuse(key, "expected a direction, found a vector of length 0");
  return vector.normalized();
}

Eigen::Vector3d quantity_vector(const StudyTable& table, const std::string& key) {
  const std::vector<double> values = table.quantities(key, 3);
  return Eigen::Map<const Eigen::Vector3d>(values.data());
}

}  // namespace flexneck::pipeline
