// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <string>
#include <vector>

#include "pipeline/language/document/study_document.h"
#include "pipeline/language/model/assembly.h"

namespace flexneck::pipeline {

/// The study's bodies and forces that a case uses, and its own tables of them.
struct CaseTables {
  /// Tables that may contain such tables, each overriding those before it.
  std::vector<StudyTable> layers;
  std::vector<std::string> bodies;  ///< names of the study's bodies; empty: all
  std::vector<std::string> forces;  ///< names of the study's forces; those in the layers always act
};

/// The tables of the model language in a study (model_sections.h): bodies, markers, joints, motors
/// and forces, from which each case makes a model.
class StudyModels {
 public:
  /// @param interfaces  names of the interfaces of the study's structure
  StudyModels(const StudyTable& root, std::vector<std::string> interfaces);

  /// All tables of the study itself, which need not form a model: joints of several cases may hold
  /// the same body.
  /// @param end_time_s  time that motions over time have to cover
  /// @param resolution_s  sampling interval of expressions of time
  Assembly whole(double end_time_s, double resolution_s) const;

  /// The model of a case from the study's tables and those of its layers: a table with a name of
  /// the study's replaces the keys that it gives, another one is added. Joints and markers are
  /// included with their bodies, motors with their joints.
  /// @param begun  settings of the case: the source of its prescribed bodies' motion, its duration
  /// @throws InputError naming file, line and key for an error in the tables.
  Assembly of_case(const CaseTables& experiment, Assembly begun) const;

 private:
  std::map<std::string, std::vector<StudyTable>> sections_;
  std::vector<std::string> interfaces_;
};

}  // namespace flexneck::pipeline
