// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

#include "pipeline/laboratory/verdict/judged_figure.h"

namespace flexneck::pipeline {

/// Measured curves of head and neck, sampled at strictly increasing times.
struct ResponseCurves {
  Eigen::VectorXd time_s;        ///< counted from the first contact
  Eigen::VectorXd rotation_rad;  ///< rotation of plane D, positive in the direction of flight
  Eigen::VectorXd moment_Nm;     ///< moment about the condyles by the test's definition, SAE J211
};

/// Figures of rotation and moment for which a test has limits. Peaks are those of parabolas through
/// the largest sample and its neighbours, crossings are interpolated linearly. A maximum at the end
/// of the record is not a peak.
/// @throws std::invalid_argument for times that do not increase, or curves of unequal lengths.
std::vector<JudgedFigure> judged_response(const CertificationTest& test,
                                          const ResponseCurves& curves);

}  // namespace flexneck::pipeline
