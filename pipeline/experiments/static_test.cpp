// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/experiments/static_test.h"

#include "multibody/simulation/simulation.h"
#include "pipeline/experiments/bending_plane.h"

namespace flexneck::pipeline {

StaticTestSignals static_test_signals(const multibody::Model& model,
                                      const multibody::History& history,
                                      const CaseSection& experiment) {
  const multibody::MarkerHistory& top = history.marker("neck.top");
  const BendingPlane plane = bending_plane(experiment);
  StaticTestSignals signals;
  signals.time_s = history.time_s;
  signals.load.setZero(history.time_s.size());
  for (const multibody::PointForce& force : model.forces.of<multibody::PointForce>())
    signals.load +=
        history.time_s.unaryExpr([&](double time_s) { return force.magnitude_N.value(time_s); });
  signals.rotation = relative_rotation(top, history.marker("neck.base"), plane);
  signals.base_moment = bending_moment(history.joint("clamp"), plane);
  signals.deflection =
      (plane.tip.transpose() * (top.position_m.colwise() - top.position_m.col(0))).transpose();
  const Eigen::VectorXd chord =
      (top.position_m - history.marker("neck.base").position_m).colwise().norm().transpose();
  signals.stretch = chord.array() / chord[0] - 1;
  return signals;
}

namespace {

/// Slope of moment over rotation between two samples.
double stiffness(const StaticTestSignals& signals, Eigen::Index from, Eigen::Index to) {
  return (signals.base_moment[to] - signals.base_moment[from]) /
         (signals.rotation[to] - signals.rotation[from]);
}

}  // namespace

multibody::History settled_static_test(const Study& study, const CaseSection& experiment,
                                       const multibody::Model& model) {
  constexpr int kLoads = 40;
  return multibody::settle(model, study.solver,
                           {experiment.duration_s, experiment.duration_s / kLoads});
}

std::vector<multibody::Channel> static_test_channels(const StaticTestSignals& signals) {
  std::vector<multibody::Channel> channels;
  const auto add = [&](const char* name, const char* unit, const Eigen::VectorXd& values) {
    channels.push_back({name, unit, {name}, values.transpose(), ""});
  };
  add("load", "N", signals.load);
  add("rotation", "rad", signals.rotation);
  add("deflection", "m", signals.deflection);
  add("base moment", "N*m", signals.base_moment);
  return channels;
}

StaticTestResult static_test_result(const StaticTestSignals& signals) {
  const Eigen::Index last = signals.rotation.size() - 1;
  const Eigen::Index tenth = last / 10;
  StaticTestResult result;
  result.rotation = signals.rotation[last];
  result.base_moment = signals.base_moment[last];
  result.deflection = signals.deflection[last];
  result.initial_stiffness = stiffness(signals, 0, tenth);
  result.final_stiffness = stiffness(signals, last - tenth, last);
  return result;
}

}  // namespace flexneck::pipeline
