// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/experiments/pendulum.h"

#include <cmath>

#include "geometry/foundation/error.h"
#include "geometry/foundation/names.h"
#include "pipeline/experiments/bending_plane.h"
#include "pipeline/experiments/case_model.h"
#include "pipeline/model/pulse.h"

namespace flexneck::pipeline {

using multibody::History;
using multibody::MarkerHistory;
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

PendulumSignals pendulum_signals(const History& history, const CaseSection& experiment) {
  const MarkerHistory& base = history.marker("neck.base");
  const MarkerHistory& top = history.marker("neck.top");
  const MarkerHistory& centre = history.marker("head.cg");
  const MarkerHistory& arm = history.marker("arm.end");
  const BendingPlane plane = bending_plane(experiment.direction);

  PendulumSignals signals;
  signals.head_rotation = relative_rotation(history.marker("head.condyles"), arm, plane);
  signals.base_moment = bending_moment(history.joint("j1"), plane);
  signals.occipital_moment = bending_moment(history.joint("j2"), plane);
  const Eigen::Index count = history.time_s.size();
  signals.neck_rotation.resize(count);
  signals.head_acceleration.resize(count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const Eigen::Quaterniond to_arm = rotation_at(arm, k).conjugate();
    const Eigen::Vector3d chord = to_arm * (top.position_m.col(k) - base.position_m.col(k));
    signals.neck_rotation[k] = std::atan2(chord.dot(plane.tip), chord.z());
    signals.head_acceleration[k] = (to_arm * centre.acceleration_m_s2.col(k)).dot(plane.motion);
  }
  return signals;
}

PendulumResult pendulum_result(const Study& study, const CaseSection& experiment,
                               const History& history) {
  const PendulumSignals signals = pendulum_signals(history, experiment);
  const auto peak = [&](const Eigen::VectorXd& signal) {
    return multibody::largest_peak(history.time_s, signal);
  };
  PendulumResult result;
  result.head_rotation = peak(signals.head_rotation);
  result.neck_rotation = peak(signals.neck_rotation);
  result.head_acceleration = peak(signals.head_acceleration);
  result.base_moment = peak(signals.base_moment);
  result.occipital_moment = peak(signals.occipital_moment);
  result.equilibrium_rotation = signals.head_rotation[0];
  const double pulse_end = driven_body(study, experiment).pulse_times_s.back();
  const multibody::FreeOscillation oscillation = multibody::free_oscillation(
      history.time_s, signals.head_rotation, result.equilibrium_rotation, pulse_end);
  result.run_frequency_Hz = multibody::cycle_frequency_Hz(oscillation);
  result.run_damping_ratio = multibody::cycle_damping_ratio(oscillation);
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
