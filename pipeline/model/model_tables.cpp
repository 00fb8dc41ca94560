// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/foundation/error.h"
#include "geometry/foundation/names.h"
#include "multibody/numerics/rotation.h"
#include "pipeline/document/table_values.h"
#include "pipeline/model/model_sections.h"

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
  return Eigen::Quaterniond(multibody::rotation_exp(quantity_vector(table, key)));
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
      table.refuse(key, "is given twice, here and by the key '" + keys.file +
                            "'; leave one out, over a table of another file by " + key + " = []");
  const std::filesystem::path path = table.file(keys.file);
  return read_csv_columns(path, keys.x_unit, keys.y_unit, table.text("column"));
}

}  // namespace flexneck::pipeline
