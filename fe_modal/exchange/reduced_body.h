// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "fe_modal/body/modal_body.h"

namespace flexneck::fe_modal {

/// A reduced body from another program's file: its modes may have any scale and any order, and mass
/// and stiffness may couple them.
struct ReducedBody {
  InertiaInvariants invariants;   ///< invariants of the file's modes; Maa is their generalised mass
  Eigen::MatrixXd stiffness;      ///< generalised, (m, m)
  Eigen::MatrixXd damping;        ///< generalised, (m, m); zero for none
  std::vector<ModeRecord> modes;  ///< names and kinds in the file; empty if it has none
  std::vector<Interface> nodes;   ///< frames that move with the modes
  std::vector<std::string> notes;  ///< a sentence for each item of the file that is not imported
};

/// A modal body of this program, and the items of its file that are not in it.
struct ImportedModes {
  ModalBody body;
  std::vector<std::string> notes;
};

/// Imports a reduced body: makes the modes mass-orthonormal and uncoupled, if they are not, by the
/// reduced eigenproblem; they are then called "mode 1", …. Every node becomes an interface, and the
/// body's nodes are the interfaces alone.
/// @throws InputError for a physically impossible body (modal_body_check.h), such as one with a
/// mass that is not positive or invariants that contradict one another.
ImportedModes import_modes(const ReducedBody& reduced);

/// Integral -int rho ~p ~q from its symmetric part and int rho p x q, equations.md section 2.
Eigen::Matrix3d inertia_integral(const Eigen::Matrix3d& symmetric, const Eigen::Vector3d& cross);

/// Refuses redundant numbers of a file that differ.
/// @param difference  largest difference of the entries
/// @param scale       size of the numbers themselves
/// @throws InputError "<these> contradict each other by …" above a millionth of the scale.
void require_agreement(const std::string& these, double difference, double scale);

/// Text with name and kind of a mode, such as "fore-aft bending 1, normal", for formats that have a
/// comment for each mode, and its inverse. A text of another program gives an empty name and kind.
std::string text_of_mode(const ModeRecord& mode);
ModeRecord mode_of_text(const std::string& text);

}  // namespace flexneck::fe_modal
