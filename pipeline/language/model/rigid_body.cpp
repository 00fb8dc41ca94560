// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/language/model/rigid_body.h"

#include "pipeline/language/document/table_values.h"

namespace flexneck::pipeline {

Eigen::Matrix3d read_inertia(const StudyTable& table, const std::string& key) {
  std::vector<double> i = table.quantities(key);
  if (i.size() == 3) i.resize(6, 0);
  if (i.size() != 6) {
    table.refuse(key, "expected 3 entries (xx, yy, zz) or 6 (and xy, xz, yz), found " +
                          std::to_string(i.size()));
  }
  Eigen::Matrix3d tensor;
  tensor << i[0], i[3], i[4], i[3], i[1], i[5], i[4], i[5], i[2];
  return tensor;
}

multibody::RigidBody read_rigid(const StudyTable& body) {
  return {body.quantity("mass"), quantity_vector(body, "center"), read_inertia(body, "inertia")};
}

}  // namespace flexneck::pipeline
