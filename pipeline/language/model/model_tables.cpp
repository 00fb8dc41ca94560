// SPDX-License-Identifier: GPL-3.0-or-later
#include <numbers>

#include <fmt/core.h>

#include "geometry/foundation/error.h"
#include "geometry/foundation/names.h"
#include "multibody/numerics/rotation.h"
#include "pipeline/language/document/table_values.h"
#include "pipeline/language/model/model_sections.h"

namespace flexneck::pipeline {

std::vector<ModelSection> model_sections() {
  std::vector<ModelSection> all = {body_section(), marker_section(), joint_section(),
                                   motor_section()};
  const std::vector<ModelSection> forces = force_sections();
  all.insert(all.end(), forces.begin(), forces.end());
  return all;
}

std::size_t reference(const StudyTable& table, const std::string& key,
                      const std::vector<std::string>& names, const std::string& kind) {
  try {
    return find_name(names, table.text(key), kind);
  } catch (const InputError& error) {
    table.refuse(key, error.what());
  }
}

Eigen::Quaterniond rotation_or_none(const StudyTable& table, const std::string& key) {
  if (!table.has(key)) return Eigen::Quaterniond::Identity();
  const Eigen::Vector3d turn = quantity_vector(table, key);
  constexpr double kTurn = 2 * std::numbers::pi * (1 + 1e-9);
  if (turn.norm() > kTurn)
    table.refuse(
        key,
        fmt::format("expected a rotation vector of less than one full revolution, found a length "
                    "of {:.6g} rad; subtract full revolutions, or give the angle of a joint",
                    turn.norm()));
  return Eigen::Quaterniond(multibody::rotation_exp(turn));
}

std::vector<double> breakpoints(const StudyTable& table) {
  return table.has("breakpoints") ? table.quantities("breakpoints") : std::vector<double>{};
}

TableColumns read_columns(const StudyTable& table, const ColumnKeys& keys) {
  if (!table.has(keys.file)) {
    TableColumns columns;
    columns.x = table.quantities(keys.x, 0, keys.x_unit);
    columns.y = table.quantities(keys.y, columns.x.size(), keys.y_unit);
    return columns;
  }
  for (const std::string& key : {keys.x, keys.y})
    if (table.has(key))
      table.refuse(key, "is given both by this key and by the key '" + keys.file +
                            "'; remove one of them, or override a table of an included file by " +
                            key + " = []");
  const std::filesystem::path path = table.file(keys.file);
  return read_csv_columns(path, keys.x_unit, keys.y_unit, table.text("column"));
}

}  // namespace flexneck::pipeline
