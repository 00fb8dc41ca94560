// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>
#include <vector>

#include "geometry/foundation/error.h"
#include "pipeline/language/document/study_document.h"
#include "pipeline/language/model/assembly.h"
#include "pipeline/language/model/csv_table.h"

namespace flexneck::pipeline {

/// A kind of table in a model file and in the models of a study.
struct ModelSection {
  Key key;
  /// Adds the content of one table, and refuses errors that the table alone reveals.
  void (*read)(const StudyTable& table, Assembly& assembly);
};
ModelSection body_section();
ModelSection marker_section();
ModelSection joint_section();
ModelSection motor_section();
ModelSection bushing_section();
ModelSection elastic_section();
std::vector<ModelSection> force_sections();  ///< for each kind of force element
/// All sections, in the order in which one kind of table may refer to another.
std::vector<ModelSection> model_sections();

/// Index of the thing that a key names. @throws InputError with the nearest name.
std::size_t reference(const StudyTable& table, const std::string& key,
                      const std::vector<std::string>& names, const std::string& kind);
std::size_t marker_named(const StudyTable& table, const std::string& key, const Assembly& assembly);
/// Reads a rotation vector, axis times angle; the identity if the key is absent.
Eigen::Quaterniond rotation_or_none(const StudyTable& table, const std::string& key);

/// Reads the motion of a [[body]] of kind "prescribed", by the keys prescribed_body_keys(), unless
/// assembly.motion leaves it to a case.
std::span<const Key> prescribed_body_keys();
multibody::PrescribedBody prescribed_body(const StudyTable& table, Assembly& assembly);

/// Calls make() and prefixes the key to its input errors.
template <class Make>
auto at_key(const StudyTable& table, const std::string& key, const Make& make) {
  try {
    return make();
  } catch (const InputError& error) {
    table.refuse(key, error.what());
  }
}

/// Key of the breakpoints of an expression of time.
inline constexpr Key kBreakpointsKey =
    Key::quantities("breakpoints", "s", kNone,
                    "Breakpoints of an expression: increasing times at which a time step ends; "
                    "features between them may be shorter than solver.resolution");
std::vector<double> breakpoints(const StudyTable& table);

/// Names and units of the two columns of a table, and the key of its file.
struct ColumnKeys {
  std::string x, x_unit, y, y_unit;
  std::string file = "table";
};
/// Reads two lists under the keys x and y, or a file (csv_table.h).
TableColumns read_columns(const StudyTable& table, const ColumnKeys& keys);

}  // namespace flexneck::pipeline
