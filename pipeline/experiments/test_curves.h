// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "multibody/files/history_file.h"
#include "pipeline/laboratory/verdict/verdict.h"
#include "pipeline/language/study/study.h"

namespace flexneck::pipeline {

/// Curves that a test measures in a case of the pendulum: rotation of the head relative to the arm,
/// the virtual load cell's moment, and the case's pulse at the accelerometer by the test's channel
/// class. Time zero is the arm's impact.
/// @param channels  channels in the case's file
/// @throws InputError if one is missing.
TestCurves test_curves(const Study& study, const TestSection& test, const CaseSection& experiment,
                       const Eigen::VectorXd& time_s,
                       const std::vector<multibody::Channel>& channels);

/// Text on how the case's definition of the moment differs from the test's; empty if it does not.
std::string moment_difference(const TestSection& test, const CaseSection& experiment);

}  // namespace flexneck::pipeline
