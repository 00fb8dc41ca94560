// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "fe_modal/body/modal_body.h"

namespace flexneck::fe_modal {

/// Frequencies of the reduced body with a rigid one on an interface, without gravity. At most six,
/// or as many as the reduced system has.
struct ModeCountRow {
  std::string kept;               ///< "2", or "4 bending" for the four lowest bending modes
  Eigen::VectorXd modes_only_Hz;  ///< those of the kept normal modes
  Eigen::VectorXd corrected_Hz;   ///< those with the residual attachment modes of the kept modes
};

/// Shows whether there are enough modes for a given attached body, by comparison with the finite
/// element frequencies in AttachedFrequencies. Rows are for the lowest 2, 4, 6, 10, 20, … normal
/// modes, the four lowest bending modes, and all of them, as far as the body has them. The file's
/// data suffices: the contribution of residual modes to any choice of modes follows from the
/// interface's static response.
/// @param attached gives its mass matrix and interface
/// @return empty if the mass matrix or the static response is not known
std::vector<ModeCountRow> mode_count_study(const ModalBody& body,
                                           const AttachedFrequencies& attached);

}  // namespace flexneck::fe_modal
