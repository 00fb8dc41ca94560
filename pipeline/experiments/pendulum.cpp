// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/experiments/pendulum.h"

#include <cmath>
#include <ctime>
#include <limits>

#include "geometry/foundation/error.h"
#include "geometry/foundation/names.h"
#include "multibody/analysis/linearisation.h"
#include "multibody/history/incomplete_run.h"
#include "multibody/joints/joint_kinds.h"
#include "pipeline/experiments/bending_plane.h"
#include "pipeline/experiments/case_model.h"
#include "pipeline/experiments/pendulum_signals.h"
#include "pipeline/experiments/sampling.h"
#include "pipeline/language/model/placement.h"

namespace flexneck::pipeline {

using multibody::History;
using multibody::Model;

namespace {

/// Prescribed motion of a case's arm.
/// @param to_world  rotation from the arm's axes, which are the neck's
multibody::PrescribedBody arm_motion(const CaseSection& experiment, const FittedPulse& pulse,
                                     const Eigen::Quaterniond& to_world) {
  const Eigen::Vector3d along = to_world * bending_plane(experiment).motion;
  multibody::PrescribedBody prescribed;
  if (experiment.arm == CaseSection::Arm::translating) {
    prescribed.direction = along;
    prescribed.initial_velocity_m_s = experiment.impact_velocity_m_s;
    prescribed.acceleration_m_s2 = pulse.acceleration();
    return prescribed;
  }
  // The pivot is above the accelerometer: w x (0, 0, -r) points along the motion.
  const double radius = experiment.accelerometer_distance_m;
  prescribed.turn.axis = along.cross(Eigen::Vector3d::UnitZ());
  prescribed.turn.point_m = {0, 0, experiment.pivot_distance_m};
  prescribed.turn.initial_rate_rad_s = experiment.impact_velocity_m_s / radius;
  prescribed.turn.acceleration_rad_s2 = pulse.acceleration(1 / radius);
  return prescribed;
}

/// Processor time of the calling thread, s.
double processor_time() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace

FittedPulse case_pulse(const Study& study, const CaseSection& experiment) {
  const PulseSection& pulse =
      study.pulses[find_name(names_of(study.pulses), experiment.pulse, "pulse")];
  try {
    return fitted_pulse(pulse.times_s, pulse.deceleration_m_s2, experiment.impact_velocity_m_s,
                        experiment.pulse_scaling);
  } catch (const InputError& error) {
    throw InputError("pulse." + pulse.name + ": " + error.what());
  }
}

Model pendulum_model(const Study& study, const CaseSection& experiment,
                     const fe_modal::ModalBody& body) {
  Model model = case_model(experiment, body);
  multibody::Body& arm = model.bodies[experiment.model.prescribed.front()];
  arm.kind = arm_motion(experiment, case_pulse(study, experiment), arm.initial_pose.rotation);
  model.gravity_m_s2 = study.gravity_m_s2;
  return model;
}

namespace {

/// Model ready to run; with a rotating arm all bodies start with the arm's rotation.
Model prepared_model(const Study& study, const CaseSection& experiment,
                     const fe_modal::ModalBody& body) {
  Model model = pendulum_model(study, experiment, body);
  if (experiment.arm == CaseSection::Arm::rotating)
    carry_bodies(model, experiment.model.starts, experiment.model.moving);
  return model;
}

History simulate_case(const Model& model, const Study& study, const CaseSection& experiment,
                      const multibody::OutputOptions& output) {
  return experiment.arm == CaseSection::Arm::rotating
             ? multibody::simulate(model, study.solver, output)
             : multibody::simulate_from_equilibrium(model, study.solver, output);
}

/// History of the run, shorter if it ended early.
History history_of(const Model& model, const Study& study, const CaseSection& experiment,
                   const multibody::OutputOptions& output) {
  try {
    return simulate_case(model, study, experiment, output);
  } catch (const multibody::IncompleteRun& stopped) {
    if (stopped.history.time_s.size() == 0) throw;
    return stopped.history;
  }
}

}  // namespace

IntegrationCost integration_cost(const Study& study, const CaseSection& experiment,
                                 const fe_modal::ModalBody& body) {
  const Model model = prepared_model(study, experiment, body);
  const double start_s = processor_time();
  const History history =
      simulate_case(model, study, experiment, {experiment.duration_s, experiment.duration_s});
  return {processor_time() - start_s, history.statistics.evaluations};
}

PendulumRun run_pendulum(const Study& study, const CaseSection& experiment,
                         const fe_modal::ModalBody& body) {
  const Model model = prepared_model(study, experiment, body);
  const int every = samples_per_output(study.output_interval_s);
  const History history = history_of(model, study, experiment,
                                     {experiment.duration_s, study.output_interval_s / every});
  PendulumRun run;
  run.channels =
      pendulum_channels(history.time_s, pendulum_signals(model, history, experiment), experiment);
  for (multibody::Channel& channel : run.channels)
    channel.values = thinned(channel.values.transpose(), every).transpose();
  run.history = thinned(history, every);
  return run;
}

PendulumRun run_pendulum_unfiltered(const Study& study, const CaseSection& experiment,
                                    const fe_modal::ModalBody& body) {
  const Model model = prepared_model(study, experiment, body);
  PendulumRun run;
  run.history =
      history_of(model, study, experiment, {experiment.duration_s, study.output_interval_s});
  run.channels = unfiltered_channels(pendulum_signals(model, run.history, experiment));
  return run;
}

PendulumResult pendulum_result(const Study& study, const CaseSection& experiment,
                               const Eigen::VectorXd& time_s,
                               const std::vector<multibody::Channel>& channels) {
  const auto peak = [&](const char* channel) {
    return multibody::largest_peak(time_s, channel_named(channels, channel));
  };
  // A stiff neck may swing back further than it was thrown.
  const double sense = experiment.direction == CaseSection::Direction::extension ? -1 : 1;
  const auto thrown = [&](const char* channel) {
    const Eigen::VectorXd signal = sense * channel_named(channels, channel);
    multibody::Peak found = multibody::largest_peak(time_s, signal.cwiseMax(0));
    found.value *= sense;
    return found;
  };
  PendulumResult result;
  result.head_rotation = thrown("head rotation");
  result.neck_rotation = thrown("neck rotation");
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  result.head_acceleration = has_channel(channels, kFilteredHeadAcceleration)
                                 ? peak(kFilteredHeadAcceleration)
                                 : multibody::Peak{kUnknown, kUnknown};
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
      oscillation_after(case_pulse(study, experiment).times_s.back());
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

/// Keeps only those modes of a body that move in, or across, the plane through its axis. The neck
/// is symmetric about its x-z plane, so the other modes do not take part.
void keep_modes(bool fore_aft, multibody::DeformableBody& body) {
  std::vector<std::string> names;
  std::vector<Eigen::Index> kept;
  for (Eigen::Index k = 0; k < body.modes.mode_count(); ++k) {
    const fe_modal::ModeRecord& mode = body.modes.modes[static_cast<std::size_t>(k)];
    if (is_fore_aft(mode) != fore_aft) continue;
    names.push_back(mode.name);
    kept.push_back(k);
  }
  body.modes = fe_modal::select_modes(body.modes, names);
  for (Eigen::VectorXd* const each :
       {&body.damping_ratio, &body.offset, &body.initial_modal, &body.initial_modal_rate})
    if (each->size() > 0) *each = (*each)(kept).eval();
  if (body.gaps.count() > 0) body.gaps.coupling = body.gaps.coupling(Eigen::all, kept).eval();
}

/// Fixes the revolute joints whose axes are normal to that of the case's plane, and removes their
/// springs.
void fix_pins_across(const BendingPlane& plane, Model& model) {
  constexpr double kAcross = 1e-9;
  for (std::size_t k = 0; k < model.joints.size(); ++k) {
    multibody::Joint& joint = model.joints[k];
    if (joint.kind != &multibody::kRevoluteJoint || !joint.motors.empty() ||
        std::abs(joint.axis.dot(plane.axis)) > kAcross)
      continue;
    joint.kind = &multibody::kFixedJoint;
    std::erase_if(model.forces.of<multibody::JointResistance>(),
                  [&](const multibody::JointResistance& each) { return each.joint == k; });
  }
}

/// The case's model restricted to its plane, its arm at rest.
Model model_in_plane(const Study& study, CaseSection experiment, const fe_modal::ModalBody& body) {
  experiment.arm = CaseSection::Arm::translating;
  Model model = pendulum_model(study, experiment, body);
  const bool fore_aft = experiment.direction != CaseSection::Direction::lateral;
  const bool oblique = experiment.direction == CaseSection::Direction::oblique;
  for (multibody::Body& each : model.bodies)
    if (auto* const deformable = std::get_if<multibody::DeformableBody>(&each.kind))
      if (!oblique) keep_modes(fore_aft, *deformable);
  fix_pins_across(bending_plane(experiment), model);
  return model;
}

}  // namespace

multibody::SystemMode first_system_mode(const Study& study, const CaseSection& experiment,
                                        const fe_modal::ModalBody& body, bool with_gravity) {
  Model model = model_in_plane(study, experiment, body);
  if (!with_gravity) model.gravity_m_s2.setZero();
  const std::vector<multibody::SystemMode> modes = multibody::system_modes(model);
  if (modes.empty()) {
    throw InputError("case." + experiment.name +
                     ": none of the selected modes moves in the plane of the case");
  }
  // At a kink the mean stiffness is not symmetric, so that an oscillation may grow although the
  // equilibrium is stable; only a non-oscillating instability means that the neck falls over.
  const bool falls_over = modes.front().damped_frequency_Hz == 0;
  if (modes.front().is_unstable() && (modes.front().kink.empty() || falls_over)) {
    throw ComputationError("case." + experiment.name +
                           ": the equilibrium of neck and head is not stable");
  }
  return modes.front();
}

}  // namespace flexneck::pipeline
