// SPDX-License-Identifier: GPL-3.0-or-later
#include <numbers>

#include <catch2/catch.hpp>

#include "geometry/foundation/names.h"
#include "pipeline/experiments/bending_plane.h"
#include "pipeline/experiments/case_model.h"
#include "pipeline/experiments/pendulum.h"
#include "pipeline/experiments/pendulum_signals.h"
#include "pipeline/experiments/static_test.h"
#include "tests/support/beam_experiment.h"

using Catch::Matchers::Contains;
using namespace flexneck;
using namespace flexneck::pipeline;
using Direction = CaseSection::Direction;
using Experiment = testing::BeamExperiment;

namespace {

constexpr double kRounding = 1e-12;

Eigen::Vector4d elements(const Eigen::Quaterniond& q) { return {q.w(), q.x(), q.y(), q.z()}; }

/// History of a marker at rest with a given rotation.
multibody::MarkerHistory still(const std::string& name, const Eigen::Vector3d& position,
                               const Eigen::Quaterniond& rotation) {
  multibody::MarkerHistory marker;
  marker.name = name;
  marker.position_m = position;
  marker.velocity_m_s = Eigen::Vector3d::Zero();
  marker.acceleration_m_s2 = Eigen::Vector3d(-3, 0, 7);
  marker.rotation = elements(rotation);
  marker.angular_velocity_rad_s = Eigen::Vector3d::Zero();
  return marker;
}

multibody::JointHistory reaction(const std::string& name, const Eigen::Vector3d& moment) {
  multibody::JointHistory joint;
  joint.name = name;
  joint.force_N = Eigen::Vector3d::Zero();
  joint.moment_Nm = moment;
  return joint;
}

}  // namespace

TEST_CASE("the pendulum hangs head down and its joints close") {
  const Experiment experiment;
  const CaseSection& flexion = experiment.named("flexion-60");
  const multibody::Model model = pendulum_model(experiment.study, flexion, experiment.body);
  const multibody::Body& neck = model.bodies[model.body_index("neck")];
  const multibody::Body& head = model.bodies[model.body_index("head")];
  const double length = experiment.body.interface("top").position_m.z();
  CHECK((neck.initial_pose.rotation * Eigen::Vector3d::UnitZ() + Eigen::Vector3d::UnitZ()).norm() <
        kRounding);
  CHECK((neck.initial_pose.rotation * Eigen::Vector3d::UnitX() - Eigen::Vector3d::UnitX()).norm() <
        kRounding);
  CHECK((head.initial_pose.position_m - Eigen::Vector3d(0, 0, -length)).norm() < kRounding);
  CHECK(model.joints.size() == 2);
  CHECK(model.gravity_m_s2.z() == Approx(-9.80665));
}

TEST_CASE("a body takes modes by kind, and its corrections a damping of their own") {
  const std::string first = Experiment().body.modes.front().name;
  Experiment experiment({R"(body.neck.modes=["residual", ")" + first + R"("])",
                         "body.neck.correction_damping_ratio=0.3"});
  std::vector<fe_modal::ModeRecord>& modes = experiment.body.modes;
  for (std::size_t k = 2; k < modes.size(); ++k) {
    modes[k].name = "residual " + std::to_string(k - 1);
    modes[k].kind = "residual";
  }
  const multibody::Model model =
      pendulum_model(experiment.study, experiment.named("flexion-60"), experiment.body);
  const auto& body =
      std::get<multibody::DeformableBody>(model.bodies[model.body_index("neck")].kind);
  REQUIRE(body.modes.mode_count() == static_cast<Eigen::Index>(modes.size()) - 1);
  CHECK(body.modes.modes.back().name == modes[0].name);
  CHECK(body.damping_ratio[0] == 0.3);
  CHECK(body.damping_ratio.tail<1>()[0] == 0.9);
  const Experiment all;
  const multibody::Model whole =
      pendulum_model(all.study, all.named("flexion-60"), experiment.body);
  CHECK(std::get<multibody::DeformableBody>(whole.bodies[whole.body_index("neck")].kind)
            .modes.mode_count() == static_cast<Eigen::Index>(modes.size()));
}

TEST_CASE("the arm comes to rest from the impact velocity, whatever the case") {
  const Experiment experiment;
  for (const char* name : {"flexion-20", "flexion-120", "lateral-65"}) {
    const CaseSection& section = experiment.named(name);
    const multibody::Model model = pendulum_model(experiment.study, section, experiment.body);
    const auto& arm =
        std::get<multibody::PrescribedBody>(model.bodies[model.body_index("arm")].kind);
    CHECK(arm.initial_velocity_m_s == section.impact_velocity_m_s);
    CHECK(std::abs(arm.initial_velocity_m_s + arm.acceleration_m_s2.integral(1.0)) <
          kRounding * arm.initial_velocity_m_s);
  }
  // Lateral: the motion is along the neck's +y, which is the world's -y when the neck hangs.
  const multibody::Model lateral =
      pendulum_model(experiment.study, experiment.named("lateral-65"), experiment.body);
  const auto& arm =
      std::get<multibody::PrescribedBody>(lateral.bodies[lateral.body_index("arm")].kind);
  CHECK((arm.direction + Eigen::Vector3d::UnitY()).norm() < kRounding);
}

TEST_CASE("the pulse at its published velocity has the published amplitude") {
  // 276 in/s is the area of the flexion pulse, rounded: the scale is one within 1e-4.
  Experiment experiment;
  CaseSection section = experiment.named("flexion-120");
  section.impact_velocity_m_s = 276 * 0.0254;
  const multibody::Model model = pendulum_model(experiment.study, section, experiment.body);
  const auto& arm = std::get<multibody::PrescribedBody>(model.bodies[model.body_index("arm")].kind);
  CHECK(arm.acceleration_m_s2.value(0.007) == Approx(-24.15 * 9.80665).epsilon(1e-4));
}

TEST_CASE("rotations of head and neck are those of the drawing") {
  const Experiment experiment;
  const double phi = 0.7;
  const double phi_neck = 0.4;
  const Eigen::Quaterniond hanging(0, 1, 0, 0);
  for (const Direction direction : {Direction::flexion, Direction::lateral}) {
    CaseSection section = experiment.named("flexion-60");
    section.direction = direction;
    const bool lateral = direction == Direction::lateral;
    // In neck axes the head rotates about +y (forward), or about -x (towards +y).
    const Eigen::Vector3d axis =
        lateral ? Eigen::Vector3d(-Eigen::Vector3d::UnitX()) : Eigen::Vector3d::UnitY();
    const Eigen::Vector3d chord = Eigen::AngleAxisd(phi_neck, axis) * Eigen::Vector3d(0, 0, 0.14);
    const Eigen::Vector3d start(1, 2, 3);
    const Eigen::Quaterniond turned = hanging * Eigen::Quaterniond(Eigen::AngleAxisd(phi, axis));
    multibody::History history;
    history.time_s = Eigen::VectorXd::Zero(1);
    history.markers = {still("arm.end", start, hanging), still("neck.base", start, hanging),
                       still("neck.top", start + hanging * chord, turned),
                       still("head.condyles", start + hanging * chord, turned),
                       still("head.cg", start, turned)};
    history.joints = {reaction("j1", {-5, 2, 0}), reaction("j2", {-7, 3, 0})};
    const PendulumSignals signals = pendulum_signals(
        pendulum_model(experiment.study, section, experiment.body), history, section);
    CHECK(signals.head_rotation[0] == Approx(phi).epsilon(kRounding));
    CHECK(signals.neck_rotation[0] == Approx(phi_neck).epsilon(kRounding));
    // SAE axes are ours with y and z reversed.
    CHECK(signals.base_moment[0] == (lateral ? -5 : -2));
    CHECK(signals.occipital_moment[0] == (lateral ? -7 : -3));
    CHECK(signals.head_acceleration[0] == Approx(lateral ? 0 : -3));
  }
}

TEST_CASE("a head thrown forward bends the neck forward and loads it in flexion") {
  const Experiment experiment;
  for (const char* name : {"flexion-20", "lateral-65"}) {
    CaseSection section = experiment.named(name);
    section.duration_s = 0.1;
    const PendulumRun run = run_pendulum(experiment.study, section, experiment.body);
    const PendulumResult result =
        pendulum_result(experiment.study, section, run.history.time_s, run.channels);
    CHECK(result.head_rotation.value > 0.05);
    CHECK(result.neck_rotation.value > 0.03);
    CHECK(result.base_moment.value > 1);
    CHECK(result.occipital_moment.value > 1);
    CHECK(result.head_acceleration.value < -10);
  }
}

TEST_CASE("at the end of a slow ramp the tester shows K^-1 f of the same modal body") {
  const Experiment experiment({R"(force.forward load.magnitudes=["0 N", "0.001 N"])"});
  const CaseSection& section = experiment.named("flexion");
  const multibody::Model model = case_model(section, experiment.body);
  const multibody::History history =
      multibody::simulate(model, experiment.study.solver, {section.duration_s, 1e-3});
  const StaticTestResult result = static_test_result(static_test_signals(model, history, section));
  const fe_modal::Interface& top = experiment.body.interface("top");
  double deflection = 0;
  double rotation = 0;
  for (Eigen::Index k = 0; k < experiment.body.mode_count(); ++k) {
    const double omega = 2 * std::numbers::pi * experiment.body.frequencies_Hz[k];
    const double a = 1e-3 * top.translation(0, k) / (omega * omega);
    deflection += top.translation(0, k) * a;
    rotation += top.rotation(1, k) * a;
  }
  // The ramp of 2 s makes the body lag by 2 zeta / omega, a few milliseconds.
  CHECK(result.deflection == Approx(deflection).epsilon(5e-3));
  CHECK(result.rotation == Approx(rotation).epsilon(5e-3));
  CHECK(result.base_moment == Approx(1e-3 * top.position_m.z()).epsilon(5e-3));
}

TEST_CASE("a case whose bodies no joint connects is refused") {
  const Experiment experiment;
  CaseSection loose = experiment.named("flexion-20");
  loose.model.model.joints.clear();
  loose.model.starts.clear();
  CHECK_THROWS_WITH(pendulum_model(experiment.study, loose, experiment.body),
                    Contains("the position of body 'neck' is not determined"));
}
