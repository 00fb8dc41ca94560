// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <string>
#include <vector>

#include "pipeline/document/study_document.h"
#include "pipeline/model/assembly.h"

namespace flexneck::pipeline {

/// What a case takes of a study's bodies, joints and forces, and what it says of them itself.
struct CaseTables {
  std::vector<StudyTable> layers;   ///< that may hold such tables, each over those before it
  std::vector<std::string> bodies;  ///< of the study's; empty: all
  std::vector<std::string> forces;  ///< of the study's; those in the layers act in any case
};

/// The tables of the model language in a study (model_sections.h): bodies, markers, joints, motors
/// and forces, of which each case makes a model.
class StudyModels {
 public:
  /// @param interfaces  of the study's structure
  StudyModels(const StudyTable& root, std::vector<std::string> interfaces);

  /// All that stands in the study itself, which need not make a model: joints of several cases may
  /// hold the same body.
  /// @param end_time_s  that motions over time have to cover
  /// @param resolution_s  of expressions of time
  Assembly whole(double end_time_s, double resolution_s) const;

  /// The study's tables that a case takes, with those of its layers: one of the same name has the
  /// keys that it gives in place of the study's, another one is added. Joints and markers are taken
  /// with their bodies, motors with their joints.
  /// @param begun  what holds for the case: how its prescribed bodies move, its length
  /// @throws InputError naming file, line and key for what cannot be.
  Assembly of_case(const CaseTables& experiment, Assembly begun) const;

 private:
  std::map<std::string, std::vector<StudyTable>> sections_;
  std::vector<std::string> interfaces_;
};

}  // namespace flexneck::pipeline
