// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fe_modal/body/modal_body.h"
#include "multibody/analysis/linearisation.h"
#include "pipeline/experiments/pendulum.h"
#include "pipeline/experiments/static_test.h"
#include "pipeline/laboratory/verdict/verdict.h"

namespace flexneck::pipeline {

/// A figure read off a result.
struct ResultValue {
  std::optional<double> value;  ///< SI
  std::string problem;          ///< reason why there is no value
};

/// SI units of figures by their names.
/// @throws InputError for an unknown name; the message lists the known ones.
std::string unit_of_modes_figure(const std::string& name);
std::string unit_of_pendulum_figure(const std::string& name);
std::string unit_of_static_figure(const std::string& name);
std::string unit_of_verdict_figure(const std::string& name, const CertificationTest& test);

/// Frequency of the structure with the body attached: by finite elements for the modes, by its
/// modes for the pendulum.
inline constexpr const char* kSystemFrequency = "system_frequency";

/// Mass of the structure.
inline constexpr const char* kMass = "mass";

/// Value of a figure of the modes: "mass"; "system_frequency" with the body attached;
/// "frequency.<mode>"; by kind and rank "frequency_by_rank.bending 2" for the second lowest; and
/// "static_stiffness.My/ry at top", load over motion of an interface under this load alone
/// (fe_modal::stiffness_name()).
/// @throws InputError for a mode that is not computed, for a missing attached body, and for an
/// interface that does not exist or has no stiffness.
double modes_figure(const fe_modal::ModalBody& body, const std::string& name);
/// True if the figure is a static stiffness.
bool is_stiffness_figure(const std::string& name);
/// Stiffness "My/ry at top" in the name of such a figure.
std::string stiffness_of_figure(const std::string& name);
/// Index of the mode whose frequency the figure gives.
std::size_t mode_of_figure(const fe_modal::ModalBody& body, const std::string& name);

/// Source from which a figure of the pendulum is read.
enum class PendulumSource {
  channels,           ///< channels without a filter
  filtered_channels,  ///< all channels, including filtered ones
  system_mode         ///< small motions about the hanging equilibrium, without a run
};
PendulumSource source_of_pendulum_figure(const std::string& name);
ResultValue pendulum_figure(const PendulumResult& result, const std::string& name);
/// Figure of a system mode; none at a kink, where small motions have no unique stiffness.
ResultValue system_figure(const multibody::SystemMode& mode, const std::string& name);

double static_figure(const StaticTestResult& result, const std::string& name);

/// A figure of a verdict, with '_' for each space of its name; "figures_inside" is the number of
/// figures within their limits.
ResultValue verdict_figure(const Verdict& verdict, const std::string& name);

}  // namespace flexneck::pipeline
