// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fe_modal/body/modal_body.h"
#include "multibody/analysis/linearisation.h"
#include "pipeline/experiments/pendulum.h"
#include "pipeline/experiments/static_test.h"
#include "pipeline/verdict/verdict.h"

namespace flexneck::pipeline {

/// A figure that was read off a result.
struct ResultValue {
  std::optional<double> value;  ///< SI
  std::string problem;          ///< why there is none
};

/// SI units of figures by their names.
/// @throws InputError for a name that is none of a kind; it tells those there are.
std::string unit_of_modes_figure(const std::string& name);
std::string unit_of_pendulum_figure(const std::string& name);
std::string unit_of_static_figure(const std::string& name);
std::string unit_of_verdict_figure(const std::string& name, const CertificationTest& test);

/// Of the structure with the body attached, by finite elements; of the pendulum, by its modes.
inline constexpr const char* kSystemFrequency = "system_frequency";

/// Of the structure.
inline constexpr const char* kMass = "mass";

/// "mass", "system_frequency" of the body attached, "frequency.<mode>", by kind and rank
/// "frequency_by_rank.bending 2", of the second lowest, and "static_stiffness.My/ry at top", load
/// by motion of an interface under this load alone (fe_modal::stiffness_name()).
/// @throws InputError for a mode that is not among those computed, without a body attached, and for
/// an interface that is none or has no stiffness.
double modes_figure(const fe_modal::ModalBody& body, const std::string& name);
/// Whether it is the last of these.
bool is_stiffness_figure(const std::string& name);
/// "My/ry at top" of such a figure.
std::string stiffness_of_figure(const std::string& name);
/// The mode whose frequency such a figure is.
std::size_t mode_of_figure(const fe_modal::ModalBody& body, const std::string& name);

/// What a figure of the pendulum is read off.
enum class PendulumSource {
  channels,           ///< those without a filter
  filtered_channels,  ///< the others too
  system_mode         ///< small motions about the hanging equilibrium: no run
};
PendulumSource source_of_pendulum_figure(const std::string& name);
ResultValue pendulum_figure(const PendulumResult& result, const std::string& name);
/// None about a kink, where small motions have no one stiffness.
ResultValue system_figure(const multibody::SystemMode& mode, const std::string& name);

double static_figure(const StaticTestResult& result, const std::string& name);

/// A figure of a verdict, with '_' for each space of its name; "figures_inside" is
/// how many of them are within their limits.
ResultValue verdict_figure(const Verdict& verdict, const std::string& name);

}  // namespace flexneck::pipeline
