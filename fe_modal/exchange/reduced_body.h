// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "fe_modal/body/modal_body.h"

namespace flexneck::fe_modal {

/// A reduced body as another program's file has it: its modes may have any scale and any order, and
/// mass and stiffness may couple them.
struct ReducedBody {
  InertiaInvariants invariants;    ///< of the file's modes; Maa is their generalised mass
  Eigen::MatrixXd stiffness;       ///< generalised, (m, m)
  Eigen::MatrixXd damping;         ///< generalised, (m, m); zero for none
  std::vector<ModeRecord> modes;   ///< names and kinds that the file tells; empty for none
  std::vector<Interface> nodes;    ///< frames that move with the modes
  std::vector<std::string> notes;  ///< what of the file is not carried over, a sentence each
};

/// A modal body of ours, and what of the file it was read from is not in it.
struct ImportedModes {
  ModalBody body;
  std::vector<std::string> notes;
};

/// Makes the modes mass-orthonormal and uncoupled, where they are not, by the reduced eigenproblem;
/// they are called "mode 1", … then. Every node becomes an interface, and the body's nodes are the
/// interfaces alone.
/// @throws InputError for what no body can have (modal_body_check.h), such as a mass that is not
/// positive or invariants that contradict one another.
ImportedModes import_modes(const ReducedBody& reduced);

/// -int rho ~p ~q from its symmetric part and int rho p x q, equations.md section 2.
Eigen::Matrix3d inertia_integral(const Eigen::Matrix3d& symmetric, const Eigen::Vector3d& cross);

/// Refuses two places of a file that say the same, but not the same number.
/// @param difference  largest of the entries
/// @param scale       of the numbers themselves
/// @throws InputError "<these> contradict each other by …" above a millionth of the scale.
void require_agreement(const std::string& these, double difference, double scale);

/// Name and kind of a mode in one text, such as "fore-aft bending 1, normal", for formats that have
/// a comment for each mode; and back. A text of another program names no mode: both are empty.
std::string text_of_mode(const ModeRecord& mode);
ModeRecord mode_of_text(const std::string& text);

}  // namespace flexneck::fe_modal
