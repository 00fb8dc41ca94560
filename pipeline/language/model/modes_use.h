// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "multibody/model/model.h"
#include "pipeline/language/document/study_document.h"

namespace flexneck::pipeline {

/// Use of modes by a [[body]] of kind "deformable", read before the modes are known.
struct ModesUse {
  std::optional<std::vector<std::string>> modes;  ///< names for fe_modal::select_modes(); none: all
  std::optional<double> damping_ratio;            ///< for all modes except correction modes
  double correction_damping_ratio = 0;            ///< for modes that are fe_modal::is_correction()
  std::vector<double> damping_ratios;             ///< one for each mode instead; empty: none
  double damping_time_s = 0;                      ///< added to all: damping over stiffness
  std::vector<double> initial_modal, initial_modal_rate;
  std::vector<double> offset;  ///< offset of the modal coordinates; empty: none
  bool stress_stiffening = false;
  StudyTable table;  ///< the body's table, for messages

  explicit ModesUse(StudyTable body) : table(std::move(body)) {}
};

/// Keys of a deformable body, except those that name the source of the modes.
std::span<const Key> modes_use_keys();
ModesUse read_modes_use(const StudyTable& body);

/// Makes the body.
/// @param from  source of the modes, for messages
/// @throws InputError at the key that does not fit the modes.
multibody::DeformableBody use_modes(const ModesUse& use, const fe_modal::ModalBody& all,
                                    const std::string& from);

}  // namespace flexneck::pipeline
