// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

#include "pipeline/verdict/judged_figure.h"

namespace flexneck::pipeline {

/// What a test measures of head and neck, a sample each at strictly increasing times.
struct ResponseCurves {
  Eigen::VectorXd time_s;        ///< from the first contact
  Eigen::VectorXd rotation_rad;  ///< of plane D, positive in the direction of flight
  Eigen::VectorXd moment_Nm;  ///< about the occipital condyles by the test's definition, SAE J211
};

/// The figures of rotation and moment that a test has limits for. Peaks are those of parabolas
/// through the largest sample and its neighbours, crossings are interpolated linearly. A peak at
/// the end of the record is none.
/// @throws std::invalid_argument for times that do not increase, or curves of other lengths.
std::vector<JudgedFigure> judged_response(const CertificationTest& test,
                                          const ResponseCurves& curves);

}  // namespace flexneck::pipeline
