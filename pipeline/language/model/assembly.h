// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "geometry/foundation/provenance.h"
#include "multibody/model/model.h"
#include "pipeline/language/model/modes_use.h"
#include "pipeline/language/model/piece_sections.h"
#include "pipeline/language/model/placement.h"

namespace flexneck::pipeline {

/// A model while its tables are read, for model files and for the cases of a study.
struct Assembly {
  /// Source of the motion of bodies of kind "prescribed".
  enum class Motion {
    given,     ///< the body's own table
    optional,  ///< the body's table, or the case that it belongs to
    by_case    ///< the case; a motion in the body's table is refused
  };

  multibody::Model model;
  std::vector<bool> posed, moving;  ///< for each body, if the file gives its pose, its velocity
  std::vector<JointStart> starts;   ///< for each joint
  double end_time_s = 1;
  double resolution_s = 1e-4;    ///< sampling interval of expressions of time, s
  bool has_expressions = false;  ///< true if expressions give motions or loads

  Motion motion = Motion::given;
  std::vector<std::size_t> prescribed;  ///< bodies of kind "prescribed"
  /// Rotation of ground and prescribed bodies whose tables give none.
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();

  /// Names of the interfaces of the structure, whose modes deformable bodies without a file of
  /// modes have, as in a study; none if every body has a file.
  std::optional<std::vector<std::string>> structure;
  /// Bodies of the structure: interfaces only until attach().
  std::map<std::size_t, ModesUse> of_structure;
  std::vector<PieceUse> of_pieces;  ///< sections that have no stiffness until attach_pieces()
  std::map<std::size_t, Relaxation> relaxations;  ///< for the sections that relax
  std::set<std::size_t> lumped;  ///< rigid bodies whose mass is that of the adjacent sections
};

/// Gives the structure's modes to the bodies that use them.
/// @throws InputError as use_modes()
void attach(const fe_modal::ModalBody& structure, Assembly& assembly);

}  // namespace flexneck::pipeline
