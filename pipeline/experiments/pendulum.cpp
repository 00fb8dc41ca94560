// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/experiments/pendulum.h"

#include "geometry/foundation/error.h"
#include "geometry/foundation/names.h"
#include "pipeline/experiments/bending_plane.h"
#include "pipeline/experiments/case_model.h"
#include "pipeline/experiments/pendulum_signals.h"
#include "pipeline/experiments/sampling.h"
#include "pipeline/model/pulse.h"

namespace flexneck::pipeline {

using multibody::History;
using multibody::Model;

namespace {

/// Head below the arm: the neck's z is the world's -z, x stays.
Eigen::Quaterniond hanging() { return {0, 1, 0, 0}; }

/// The arm's motion of a case.
multibody::DrivenBody arm_motion(const BodySection& arm, const CaseSection& experiment) {
  multibody::DrivenBody driven;
  driven.direction = hanging() * bending_plane(experiment.direction).motion;
  driven.initial_velocity_m_s = experiment.impact_velocity_m_s;
  try {
    driven.acceleration_m_s2 =
        braking_pulse(arm.pulse_times_s, arm.pulse_m_s2, experiment.impact_velocity_m_s);
  } catch (const InputError& error) {
    throw InputError("body." + arm.name + ".pulse_deceleration: " + error.what());
  }
  return driven;
}

const BodySection& driven_body(const Study& study, const CaseSection& experiment) {
  for (const std::string& name : experiment.bodies) {
    const BodySection& body = study.body(name);
    if (body.kind == BodySection::Kind::driven && !body.pulse_times_s.empty()) return body;
  }
  throw InputError("case." + experiment.name +
                   ": a pendulum needs a driven body with a pulse among its bodies");
}

}  // namespace

Model pendulum_model(const Study& study, const CaseSection& experiment,
                     const fe_modal::ModalBody& body) {
  Model model = case_model(study, experiment, body, hanging());
  const BodySection& arm = driven_body(study, experiment);
  model.bodies[model.body_index(arm.name)].kind = arm_motion(arm, experiment);
  model.gravity_m_s2 = study.gravity_m_s2;
  return model;
}

PendulumRun run_pendulum(const Study& study, const CaseSection& experiment,
                         const fe_modal::ModalBody& body) {
  const Model model = pendulum_model(study, experiment, body);
  const int every = samples_per_output(study.output_interval_s);
  const History history = multibody::simulate_from_equilibrium(
      model, study.solver, {experiment.duration_s, study.output_interval_s / every});
  PendulumRun run;
  run.channels =
      pendulum_channels(history.time_s, pendulum_signals(model, history, experiment), experiment);
  for (multibody::Channel& channel : run.channels)
    channel.values = thinned(channel.values.transpose(), every).transpose();
  run.history = thinned(history, every);
  return run;
}

PendulumResult pendulum_result(const Study& study, const CaseSection& experiment,
                               const Eigen::VectorXd& time_s,
                               const std::vector<multibody::Channel>& channels) {
  const auto peak = [&](const char* channel) {
    return multibody::largest_peak(time_s, channel_named(channels, channel));
  };
  PendulumResult result;
  result.head_rotation = peak("head rotation");
  result.neck_rotation = peak("neck rotation");
  result.head_acceleration = peak("head acceleration filtered");
  result.base_moment = peak("base moment");
  result.occipital_moment = peak("occipital moment");
  const Eigen::VectorXd rotation = channel_named(channels, "head rotation");
  result.equilibrium_rotation = rotation[0];
  const auto oscillation_after = [&](double after_s) {
    return multibody::free_oscillation(time_s, rotation, result.equilibrium_rotation, after_s);
  };
  const multibody::FreeOscillation after_peak = oscillation_after(result.head_rotation.time_s);
  if (!after_peak.crossings_s.empty()) result.zero_crossing_s = after_peak.crossings_s.front();
  const multibody::FreeOscillation free =
      oscillation_after(driven_body(study, experiment).pulse_times_s.back());
  result.run_frequency_Hz = multibody::cycle_frequency_Hz(free);
  result.run_damping_ratio = multibody::cycle_damping_ratio(free);
  return result;
}

namespace {

/// True for fore-aft and axial modes, false for lateral and twisting ones.
bool is_fore_aft(const fe_modal::ModeRecord& mode) {
  const auto& [fore_aft, lateral, twist, axial] = mode.shares_percent;
  return fore_aft + axial > lateral + twist;
}

/// The study with only those modes of its deformable bodies that move in the plane of the case. The
/// neck is symmetric about its x-z plane, so the others take no part.
Study in_plane(Study study, const CaseSection& experiment, const fe_modal::ModalBody& body) {
  const bool fore_aft = experiment.direction != CaseSection::Direction::lateral;
  for (BodySection& section : study.bodies) {
    if (section.modes.empty()) continue;
    section.modes = names_of(fe_modal::select_modes(body, section.modes).modes);  // kinds spelt out
    std::erase_if(section.modes, [&](const std::string& name) {
      const auto k = static_cast<std::size_t>(body.mode_index(name));
      return is_fore_aft(body.modes[k]) != fore_aft;
    });
  }
  return study;
}

}  // namespace

multibody::SystemMode first_system_mode(const Study& study, const CaseSection& experiment,
                                        const fe_modal::ModalBody& body, bool with_gravity) {
  Model model = pendulum_model(in_plane(study, experiment, body), experiment, body);
  if (!with_gravity) model.gravity_m_s2.setZero();
  const std::vector<multibody::SystemMode> modes = multibody::system_modes(model);
  if (modes.empty()) {
    throw InputError("case." + experiment.name +
                     ": none of the modes chosen moves in the plane of the case");
  }
  return modes.front();
}

}  // namespace flexneck::pipeline
