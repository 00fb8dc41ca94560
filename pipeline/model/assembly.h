// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "geometry/foundation/provenance.h"
#include "multibody/model/model.h"
#include "pipeline/model/modes_use.h"
#include "pipeline/model/piece_sections.h"
#include "pipeline/model/placement.h"

namespace flexneck::pipeline {

/// A model while its tables are read, which a model file and the cases of a study have alike.
struct Assembly {
  /// Who says how the bodies of kind "prescribed" move.
  enum class Motion {
    given,     ///< the body itself
    optional,  ///< the body, or the case that it is part of
    by_case    ///< the case; a motion of the body's own is refused
  };

  multibody::Model model;
  std::vector<bool> posed, moving;  ///< of each body: whether the file says where, how fast
  std::vector<JointStart> starts;   ///< of each joint
  double end_time_s = 1;
  double resolution_s = 1e-4;    ///< of expressions of time
  bool has_expressions = false;  ///< motions or loads by them

  Motion motion = Motion::given;
  std::vector<std::size_t> prescribed;  ///< bodies of that kind
  /// Of ground and prescribed bodies whose tables do not say it.
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();

  /// Names of the interfaces of the structure whose modes deformable bodies have that name no file
  /// of modes, as those of a study do; none where every body has a file.
  std::optional<std::vector<std::string>> structure;
  std::map<std::size_t, ModesUse> of_structure;  ///< such bodies: interfaces only until attach()
  std::vector<PieceUse> of_pieces;  ///< sections without stiffness until attach_pieces()
  std::map<std::size_t, Relaxation> relaxations;  ///< of sections that relax
  std::set<std::size_t> lumped;  ///< rigid bodies whose mass is that of the sections at them
};

/// Gives the bodies of the structure its modes.
/// @throws InputError as use_modes()
void attach(const fe_modal::ModalBody& structure, Assembly& assembly);

}  // namespace flexneck::pipeline
