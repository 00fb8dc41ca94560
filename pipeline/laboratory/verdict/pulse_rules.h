// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

#include "pipeline/laboratory/verdict/judged_figure.h"

namespace flexneck::pipeline {

/// Deceleration of the pendulum at its accelerometer, filtered as the test requires.
struct PulseCurve {
  Eigen::VectorXd time_s;  ///< counted from the first contact, strictly increasing
  Eigen::VectorXd deceleration_m_s2;
};

/// Figures of the pulse for which a test has limits.
/// @throws std::invalid_argument for times that do not increase, or curves of unequal lengths.
std::vector<JudgedFigure> judged_pulse(const CertificationTest& test, const PulseCurve& pulse);

/// The impact velocity and the pulse, which are conditions of the test and not its results.
/// @throws as judged_pulse()
std::vector<JudgedFigure> judged_conditions(const CertificationTest& test,
                                            double impact_velocity_m_s, const PulseCurve& pulse);

}  // namespace flexneck::pipeline
