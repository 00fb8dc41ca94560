// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/document/table_values.h"

#include "geometry/foundation/names.h"

namespace flexneck::pipeline {

std::size_t choice(const StudyTable& table, const std::string& key,
                   const std::vector<std::string>& names) {
  const std::string name = table.text(key);
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i] == name) return i;
  }
  std::string expected = "expected one of";
  for (const std::string& each : names) expected += " \"" + each + "\"";
  table.refuse(key, expected + ", found \"" + name + "\"" + did_you_mean(names, name));
}

std::size_t choice_or_first(const StudyTable& table, const std::string& key,
                            const std::vector<std::string>& names) {
  return table.text_or(key, names.front()) == names.front() ? 0 : choice(table, key, names);
}

Eigen::Vector3d unit_vector(const StudyTable& table, const std::string& key) {
  const std::vector<double> numbers = table.numbers(key, 3);
  const Eigen::Vector3d vector = Eigen::Map<const Eigen::Vector3d>(numbers.data());
  if (!(vector.norm() > 0)) table.refuse(key, "expected a direction, found a vector of length 0");
  return vector.normalized();
}

Eigen::Vector3d quantity_vector(const StudyTable& table, const std::string& key,
                                const std::string& si_unit) {
  const std::vector<double> values = table.quantities(key, si_unit, 3);
  return Eigen::Map<const Eigen::Vector3d>(values.data());
}

}  // namespace flexneck::pipeline
