// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "multibody/files/history_file.h"
#include "multibody/history/history.h"
#include "pipeline/language/study/study.h"

namespace flexneck::pipeline {

/// Curves over time of the static neck tester: base clamped by the joint "clamp", no gravity, a
/// force at the joint point with a constant direction in space.
struct StaticTestSignals {
  Eigen::VectorXd time_s;
  Eigen::VectorXd load;  ///< loads of the model's forces, along their directions, N
  /// Rotation of the top relative to the base, rad, forward (or +y) positive.
  Eigen::VectorXd rotation;
  Eigen::VectorXd base_moment;  ///< N m, SAE J211 sign of the channel (My or Mx)
  Eigen::VectorXd deflection;   ///< deflection of the joint point, m
  /// Distance of the joint point from the base over its value at rest, minus one: the spurious
  /// elongation. A neck nearly keeps its length; a linear body's top moves along a straight line.
  Eigen::VectorXd stretch;
};

/// Evaluates a run.
/// @param model  the model that was run
StaticTestSignals static_test_signals(const multibody::Model& model,
                                      const multibody::History& history,
                                      const CaseSection& experiment);

/// Static solutions at forty loads of the case's ramp: no inertia, no damping.
multibody::History settled_static_test(const Study& study, const CaseSection& experiment,
                                       const multibody::Model& model);

/// The channels of a static test's file, SI units.
std::vector<multibody::Channel> static_test_channels(const StaticTestSignals& signals);

/// End of the ramp and slopes of moment over rotation.
struct StaticTestResult {
  double rotation = 0;           ///< rad
  double base_moment = 0;        ///< N m
  double deflection = 0;         ///< m
  double initial_stiffness = 0;  ///< N m/rad, over the first tenth of the ramp
  double final_stiffness = 0;    ///< N m/rad, over the last tenth
};

StaticTestResult static_test_result(const StaticTestSignals& signals);

}  // namespace flexneck::pipeline
