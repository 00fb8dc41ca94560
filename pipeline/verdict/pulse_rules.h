// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

#include "pipeline/verdict/judged_figure.h"

namespace flexneck::pipeline {

/// Of the pendulum at its accelerometer, filtered as the test says.
struct PulseCurve {
  Eigen::VectorXd time_s;  ///< from the first contact, strictly increasing
  Eigen::VectorXd deceleration_m_s2;
};

/// What a test has limits for of the pulse.
/// @throws std::invalid_argument for times that do not increase, or curves of other lengths.
std::vector<JudgedFigure> judged_pulse(const CertificationTest& test, const PulseCurve& pulse);

/// The impact velocity and the pulse. They are conditions of the test, no results of it.
/// @throws as judged_pulse()
std::vector<JudgedFigure> judged_conditions(const CertificationTest& test,
                                            double impact_velocity_m_s, const PulseCurve& pulse);

}  // namespace flexneck::pipeline
