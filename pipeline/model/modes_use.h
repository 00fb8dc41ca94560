// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "multibody/model/model.h"
#include "pipeline/document/study_document.h"

namespace flexneck::pipeline {

/// How a [[body]] of kind "deformable" uses modes that are known later.
struct ModesUse {
  std::optional<std::vector<std::string>> modes;  ///< as fe_modal::select_modes(); none: all
  std::optional<double> damping_ratio;            ///< of all modes but …
  double correction_damping_ratio = 0;            ///< … those that are fe_modal::is_correction()
  std::vector<double> damping_ratios;             ///< or of each mode; empty: none
  double damping_time_s = 0;                      ///< besides: damping over stiffness
  std::vector<double> initial_modal, initial_modal_rate;
  std::vector<double> offset;  ///< of the modal coordinates; empty: none
  bool stress_stiffening = false;
  StudyTable table;  ///< that says so; for messages

  explicit ModesUse(StudyTable body) : table(std::move(body)) {}
};

/// Keys of a deformable body, but for those that say where the modes are.
std::span<const Key> modes_use_keys();
ModesUse read_modes_use(const StudyTable& body);

/// @param from  where the modes are from, for messages
/// @throws InputError at the key that does not fit the modes.
multibody::DeformableBody use_modes(const ModesUse& use, const fe_modal::ModalBody& all,
                                    const std::string& from);

}  // namespace flexneck::pipeline
