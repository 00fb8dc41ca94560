// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "geometry/foundation/error.h"
#include "multibody/model/model.h"
#include "pipeline/document/study_document.h"
#include "pipeline/model/csv_table.h"
#include "pipeline/model/placement.h"

namespace flexneck::pipeline {

/// A model while its file is read.
struct Assembly {
  multibody::Model model;
  std::vector<bool> posed, moving;  ///< of each body: whether the file says where, how fast
  std::vector<JointStart> starts;   ///< of each joint
  double end_time_s = 1;
  std::vector<InputFile> files;  ///< modes and tables read
};

// Each adds what one table of the file says, and refuses what the table alone shows to be wrong.
void read_body(const StudyTable& table, Assembly& assembly);        ///< [[body]]
void read_marker(const StudyTable& table, Assembly& assembly);      ///< [[marker]]
void read_joint(const StudyTable& table, Assembly& assembly);       ///< [[joint]]
void read_motor(const StudyTable& table, Assembly& assembly);       ///< [[motor]]
void read_force(const StudyTable& table, Assembly& assembly);       ///< [[force]]
void read_torque(const StudyTable& table, Assembly& assembly);      ///< [[torque]]
void read_spring(const StudyTable& table, Assembly& assembly);      ///< [[spring]]
void read_bushing(const StudyTable& table, Assembly& assembly);     ///< [[bushing]]
void read_resistance(const StudyTable& table, Assembly& assembly);  ///< [[resistance]]
void read_line_force(const StudyTable& table, Assembly& assembly);  ///< [[line_force]]

/// Position of the thing that a key names. @throws InputError with the nearest name.
std::size_t reference(const StudyTable& table, const std::string& key,
                      const std::vector<std::string>& names, const std::string& kind);
std::size_t marker_named(const StudyTable& table, const std::string& key, const Assembly& assembly);
/// A rotation vector, axis times angle; none if the key is not there.
Eigen::Quaterniond rotation_or_none(const StudyTable& table, const std::string& key);

/// The motion that a [[body]] of kind "driven" gives.
multibody::DrivenBody driven_body(const StudyTable& table, Assembly& assembly);

/// Calls make() and puts the key in front of what it refuses.
template <class Make>
auto at_key(const StudyTable& table, const std::string& key, const Make& make) {
  try {
    return make();
  } catch (const InputError& error) {
    table.refuse(key, error.what());
  }
}

/// Names and units of the two columns of a table, and the key of its file.
struct ColumnKeys {
  std::string x, x_unit, y, y_unit;
  std::string file = "table";
};
/// Two lists under the keys x and y, or a CSV file.
TableColumns read_columns(const StudyTable& table, const ColumnKeys& keys,
                          std::vector<InputFile>& files);

}  // namespace flexneck::pipeline
