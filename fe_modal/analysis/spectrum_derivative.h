// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "fe_modal/analysis/sensitivity.h"

namespace flexneck::fe_modal {

/// Neighbouring modes that are nearly equal; a single one is a group, too.
struct ModeGroup {
  Eigen::Index first = 0;
  Eigen::Index count = 1;
};

/// Divides a spectrum into groups of nearly equal modes.
/// @param frequencies_Hz ascending, above zero
std::vector<ModeGroup> groups_of(const Eigen::VectorXd& frequencies_Hz);

/// A group and Phi^T (dK - lambda dM) Phi, (count, count), for each parameter.
struct GroupDerivative {
  ModeGroup group;
  std::vector<Eigen::MatrixXd> by_parameter;
};

/// The m frequencies of one eigenproblem.
struct Spectrum {
  std::vector<std::string> names;
  Eigen::VectorXd frequencies_Hz;  ///< ascending, above zero
  bool is_attached = false;
};

/// Appends the rows of a group and the notes on it to the result.
/// @param derivative that of the group's modes; they are numbered as in the spectrum
void add_group(const Spectrum& spectrum, const GroupDerivative& derivative, Sensitivities& result);

}  // namespace flexneck::fe_modal
