// SPDX-License-Identifier: GPL-3.0-or-later
// Runs of the pendulum, compared with references that use none of its code.
#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "fe_modal/body/skew.h"
#include "geometry/foundation/names.h"
#include "multibody/analysis/linearisation.h"
#include "pipeline/experiments/pendulum.h"
#include "pipeline/experiments/pendulum_signals.h"
#include "pipeline/experiments/rigid_neck.h"
#include "pipeline/experiments/sampling.h"
#include "tests/support/beam_experiment.h"
#include "tests/support/dense_solvers.h"

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using namespace flexneck;
using namespace flexneck::pipeline;
using Direction = CaseSection::Direction;
using Experiment = testing::BeamExperiment;

namespace {

/// Small motions of beam and head on an arm accelerated along x, by modal superposition: M q'' + C
/// q' + K q = -p a(t), in complex modes of first order because C is not proportional to M and K.
class LinearPendulum {
 public:
  LinearPendulum(const fe_modal::ModalBody& neck, double damping_ratio,
                 const multibody::RigidBody& head) {
    const fe_modal::Interface& top = neck.interface("top");
    // Motion of the head's c.g.: translation of the top and the lever of its rotation.
    B_ = top.translation - skew(head.center_m) * top.rotation;
    const MatrixXd mass = neck.invariants.Maa + head.mass_kg * B_.transpose() * B_ +
                          top.rotation.transpose() * head.inertia_kg_m2 * top.rotation;
    const VectorXd omega = 2 * std::numbers::pi * neck.frequencies_Hz;
    const MatrixXd inverse =
        testing::symmetric_solution(mass, MatrixXd::Identity(omega.size(), omega.size()));
    const Eigen::Index n = omega.size();
    MatrixXd A = MatrixXd::Zero(2 * n, 2 * n);
    A.topRightCorner(n, n).setIdentity();
    A.bottomLeftCorner(n, n) = -inverse * omega.cwiseAbs2().asDiagonal();
    A.bottomRightCorner(n, n) = -inverse * (2 * damping_ratio * omega).asDiagonal();
    VectorXd b = VectorXd::Zero(2 * n);
    b.tail(n) = -inverse * (neck.invariants.S2 + head.mass_kg * B_).row(0).transpose();
    const testing::ComplexPairs pairs = testing::complex_pairs(A);
    lambda_ = pairs.values;
    shapes_ = pairs.vectors;
    beta_ = pairs.inverse * b;
  }

  /// State [q; q'] at a time, starting at rest, under an acceleration that is linear between rows.
  VectorXd state(const std::vector<double>& times_s, const std::vector<double>& acceleration,
                 double time_s) const {
    Eigen::VectorXcd z = Eigen::VectorXcd::Zero(lambda_.size());
    double now = times_s.front();
    for (std::size_t k = 1; k < times_s.size() && now < time_s; ++k) {
      const double slope = (acceleration[k] - acceleration[k - 1]) / (times_s[k] - times_s[k - 1]);
      const double h = std::min(times_s[k], time_s) - now;
      for (Eigen::Index m = 0; m < z.size(); ++m) {
        const std::complex<double> l = lambda_[m];
        const std::complex<double> e = std::exp(l * h);
        z[m] = e * z[m] + beta_[m] * (acceleration[k - 1] * (e - 1.0) / l +
                                      slope * (e - 1.0 - l * h) / (l * l));
      }
      now += h;
    }
    for (Eigen::Index m = 0; m < z.size() && now < time_s; ++m)
      z[m] *= std::exp(lambda_[m] * (time_s - now));
    return (shapes_ * z).real();
  }

 private:
  Eigen::Matrix3Xd B_;
  Eigen::VectorXcd lambda_, beta_;
  Eigen::MatrixXcd shapes_;
};

/// Compliance of a neck's top in a plane, summed over its modes.
struct TopCompliance {
  double displacement_to_force = 0, displacement_to_moment = 0, rotation_to_moment = 0;
};

/// Fore-aft the top moves along x and rotates about y, laterally along y and about -x.
TopCompliance top_compliance(const fe_modal::ModalBody& neck, bool lateral) {
  const fe_modal::Interface& top = neck.interface("top");
  const VectorXd softness = (2 * std::numbers::pi * neck.frequencies_Hz).cwiseAbs2().cwiseInverse();
  const VectorXd u = top.translation.row(lateral ? 1 : 0).transpose();
  const VectorXd t = (lateral ? -1 : 1) * top.rotation.row(lateral ? 0 : 1).transpose();
  return {u.cwiseProduct(u).dot(softness), u.cwiseProduct(t).dot(softness),
          t.cwiseProduct(t).dot(softness)};
}

double damping_ratio(const Experiment& experiment) {
  return experiment.study.model.of_structure.begin()->second.damping_ratio.value();
}

}  // namespace

TEST_CASE("a small pulse moves head and neck as modal superposition says") {
  Experiment experiment;
  experiment.study.gravity_m_s2.setZero();
  CaseSection section = experiment.named("flexion-60");
  section.impact_velocity_m_s = 1e-3;
  section.duration_s = 0.2;
  const PendulumRun run = run_pendulum(experiment.study, section, experiment.body);
  const VectorXd head = channel_named(run.channels, "head rotation");
  const VectorXd neck = channel_named(run.channels, "neck rotation");

  const LinearPendulum truth(experiment.body, damping_ratio(experiment),
                             experiment.study.rigid_body("head"));
  const FittedPulse pulse = case_pulse(experiment.study, section);
  std::vector<double> acceleration = pulse.deceleration_m_s2;
  for (double& value : acceleration) value *= -1;
  const fe_modal::Interface& top = experiment.body.interface("top");
  const double largest = head.cwiseAbs().maxCoeff();
  // Rotations are about 1e-4: nonlinear effects are of that relative size.
  constexpr double kNotLinear = 3e-4;
  REQUIRE(largest > 5e-5);
  for (Eigen::Index k = 0; k < head.size(); k += 20) {
    const VectorXd q =
        truth.state(pulse.times_s, acceleration, run.history.time_s[k]).head(top.rotation.cols());
    INFO(run.history.time_s[k]);
    CHECK(std::abs(head[k] - top.rotation.row(1).dot(q)) < kNotLinear * largest);
    CHECK(std::abs(neck[k] - top.translation.row(0).dot(q) / top.position_m.z()) <
          kNotLinear * largest);
  }
}

TEST_CASE("moments at the condyles are what moves the head, whatever holds it") {
  const Experiment experiment;
  const char* const name = GENERATE("flexion-60", "flexion-60-spring", "flexion-60-rigid",
                                    "extension-60-equivalent", "lateral-65", "flexion-60-rotating");
  INFO(name);
  CaseSection section = experiment.named(name);
  section.duration_s = 0.1;
  const PendulumRun run = run_pendulum(experiment.study, section, experiment.body);
  const PendulumSignals signals = pendulum_signals(
      pendulum_model(experiment.study, section, experiment.body), run.history, section);
  const multibody::RigidBody& head = experiment.study.rigid_body("head");
  const multibody::MarkerHistory& cg = run.history.marker("head.cg");
  const VectorXd moment = channel_named(run.channels, "occipital moment");
  const VectorXd cell = channel_named(run.channels, "load cell moment");
  const bool lateral = section.direction == Direction::lateral;
  const double size = moment.cwiseAbs().maxCoeff();
  const Vector3d cell_m(0, 0, 0.70 * 0.0254);  // above the condyles
  for (Eigen::Index k = 0; k < moment.size(); k += 20) {
    const auto q = cg.rotation.col(k);
    const Matrix3d to_head = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).conjugate().matrix();
    const Vector3d w = to_head * cg.angular_velocity_rad_s.col(k);
    const Vector3d alpha = to_head * cg.angular_acceleration_rad_s2.col(k);
    const Vector3d force =
        head.mass_kg * (to_head * (cg.acceleration_m_s2.col(k) - experiment.study.gravity_m_s2));
    const Matrix3d& J = head.inertia_kg_m2;
    // For the axis of bending the head's axes are the neck's; SAE reverses y.
    const auto moment_about = [&](const Vector3d& point_m) {
      const Vector3d m = J * alpha + w.cross(J * w) + (head.center_m - point_m).cross(force);
      return lateral ? m.x() : -m.y();
    };
    const double expected = moment_about(Vector3d::Zero());
    const double shear = lateral ? -force.y() : force.x();
    CHECK(std::abs(moment[k] - expected) < 1e-6 * size);
    CHECK(std::abs(signals.cell_moment[k] - moment_about(cell_m)) < 1e-6 * size);
    CHECK(std::abs(signals.cell_shear[k] - shear) < 1e-6 * size / cell_m.z());
    // The formula subtracts 0.058 ft; the filter has hardly any effect.
    const double arms = (lateral ? -1 : 1) * (cell_m.z() - 0.058 * 0.3048);
    if (run.history.time_s[k] > 0.005)
      CHECK(std::abs(cell[k] - expected - arms * shear) < 5e-3 * size);
  }
}

TEST_CASE("the arm loses its velocity to the pulse, and its channels say so") {
  const Experiment experiment;
  const char* const name = GENERATE("flexion-40", "flexion-20-duration", "extension-80");
  CaseSection section = experiment.named(name);
  section.duration_s = 0.15;  // the longest pulse is stretched fivefold at most
  const PendulumRun run = run_pendulum(experiment.study, section, experiment.body);
  const VectorXd velocity = channel_named(run.channels, "arm velocity");
  CHECK(velocity[0] == Approx(section.impact_velocity_m_s).epsilon(1e-12));
  CHECK(std::abs(velocity.tail<1>()[0]) < 1e-12 * velocity[0]);
  const FittedPulse pulse = case_pulse(experiment.study, section);
  const double largest =
      *std::max_element(pulse.deceleration_m_s2.begin(), pulse.deceleration_m_s2.end());
  CHECK(channel_named(run.channels, "arm deceleration").maxCoeff() <= largest * (1 + 1e-12));
}

TEST_CASE("an arm with a pivot far away is one that translates") {
  Experiment experiment;
  experiment.study.gravity_m_s2.setZero();  // a rotating arm starts from the undeformed neck
  CaseSection translating = experiment.named("flexion-60");
  translating.duration_s = 0.1;
  CaseSection rotating = translating;
  rotating.arm = CaseSection::Arm::rotating;
  rotating.pivot_distance_m = rotating.accelerometer_distance_m = 1e5;
  const auto rotation = [&](const CaseSection& section) {
    return channel_named(run_pendulum(experiment.study, section, experiment.body).channels,
                         "head rotation");
  };
  const VectorXd straight = rotation(translating);
  // Centripetal accelerations decrease with the distance.
  CHECK((rotation(rotating) - straight).cwiseAbs().maxCoeff() < 1e-4 * straight.maxCoeff());

  // At a shorter distance the neck's base moves faster than the accelerometer below the pivot.
  rotating.pivot_distance_m = 2;
  rotating.accelerometer_distance_m = 1.6;
  const PendulumRun run = run_pendulum(experiment.study, rotating, experiment.body);
  const VectorXd velocity = channel_named(run.channels, "arm velocity");
  CHECK(velocity[0] == Approx(rotating.impact_velocity_m_s * 2 / 1.6).epsilon(1e-12));
  CHECK(std::abs(velocity.tail<1>()[0]) < 1e-9);
}

TEST_CASE("an equivalent rigid neck is as stiff and as quick as the deformable one") {
  const Experiment experiment;
  for (const char* const name : {"flexion-60", "lateral-65"}) {
    INFO(name);
    const CaseSection& section = experiment.named(name);
    const multibody::Model model = pendulum_model(experiment.study, section, experiment.body);
    const auto& neck =
        std::get<multibody::DeformableBody>(model.bodies[model.body_index("neck")].kind);
    const RigidNeck rigid = equivalent_neck(neck, section.direction);
    const double length_m = rigid.upper.height_m - rigid.lower.height_m;
    const auto stiffness = [](const multibody::Resistance& law) {
      return law.positive.load(1e-6) / 1e-6;
    };
    const bool lateral = section.direction == Direction::lateral;
    const double omega =
        2 * std::numbers::pi * (lateral ? testing::Beam().lateral_Hz : testing::Beam().fore_aft_Hz);
    // The link has the modes' own compliance, mass and damping, except for rounding.
    constexpr double kRounding = 1e-12;
    const TopCompliance modal = top_compliance(experiment.body, lateral);
    const double k1 = stiffness(rigid.lower.resistance);
    const double k2 = stiffness(rigid.upper.resistance);
    CHECK(length_m * length_m / k1 == Approx(modal.displacement_to_force).epsilon(kRounding));
    CHECK(length_m / k1 == Approx(modal.displacement_to_moment).epsilon(kRounding));
    CHECK(1 / k1 + 1 / k2 == Approx(modal.rotation_to_moment).epsilon(kRounding));
    CHECK(rigid.rigid.mass_kg == Approx(testing::Beam().mass_kg).epsilon(kRounding));
    const double damping_time_s = 2 * damping_ratio(experiment) / omega;
    CHECK(rigid.lower.resistance.damping == Approx(damping_time_s * k1).epsilon(kRounding));
    CHECK(rigid.upper.resistance.damping == Approx(damping_time_s * k2).epsilon(kRounding));

    // A clamped beam of flexural stiffness EI and length L: pivot 2 L / 3 below the top, springs 4
    // EI / 3 L and 4 EI / L. The two modes in the plane lack half a per cent of c_uF, 3 % of c_uM,
    // which counts twice, and much more of c_tM.
    const double beam_m = experiment.body.interface("top").position_m.z();
    const double EI = std::pow(omega / std::pow(testing::kClampedFree[0], 2), 2) *
                      testing::Beam().mass_kg * std::pow(beam_m, 3);
    CHECK(length_m == Approx(2 * beam_m / 3).epsilon(0.03));
    CHECK(k1 == Approx(4 * EI / (3 * beam_m)).epsilon(0.07));
    CHECK(k2 > 4 * EI / beam_m);
    // With the head attached, static compliance determines the frequency.
    const auto frequency = [&](const std::string& variant) {
      return first_system_mode(experiment.study, experiment.named(name + variant), experiment.body,
                               false);
    };
    const multibody::SystemMode deformable = frequency("");
    const multibody::SystemMode equivalent = frequency("-equivalent");
    CHECK(equivalent.frequency_Hz == Approx(deformable.frequency_Hz).epsilon(0.01));
    CHECK(equivalent.damping_ratio == Approx(deformable.damping_ratio).epsilon(0.15));
  }
}

TEST_CASE("a pin across the plane of a lateral test leaves its motion as it is") {
  const auto difference = [](const Experiment& experiment) {
    const auto rotation = [&](const std::string& name) {
      CaseSection section = experiment.named(name);
      section.duration_s = 0.1;
      return channel_named(run_pendulum(experiment.study, section, experiment.body).channels,
                           "head rotation");
    };
    const VectorXd expected = rotation("lateral-65");
    return (rotation("lateral-65-spring") - expected).cwiseAbs().maxCoeff() / expected.maxCoeff();
  };
  // The c.g. is in front of the pin: gravity, and the centrifugal load at a large rotation, make
  // the head nod.
  CHECK(difference(Experiment({R"(solver.gravity=["0 gn", "0 gn", "0 gn"])"})) < 4e-3);
  // A head that is symmetric in front of and behind the pin does not nod at all.
  CHECK(difference(Experiment(
            {R"(body.head.center=["0 in", "0 in", "2 in"])",
             R"(body.head.inertia=["0.017 kg*m^2", "0.024 kg*m^2", "0.021 kg*m^2"])"})) < 1e-9);
}

TEST_CASE("a thinned history keeps every so manieth time and the last") {
  CHECK(samples_per_output(5e-4) == 5);
  CHECK(samples_per_output(1e-4) == 1);
  CHECK(samples_per_output(1.5e-4) == 2);
  CHECK(samples_per_output(1e-5) == 1);
  multibody::History history;
  history.time_s = VectorXd::LinSpaced(8, 0, 7);
  history.markers.resize(1);
  history.markers[0].position_m = history.time_s.transpose().replicate(3, 1);
  const multibody::History thin = thinned(history, 3);
  CHECK(thin.time_s == Eigen::Vector4d(0, 3, 6, 7));
  CHECK(thin.markers[0].position_m.row(1).transpose() == thin.time_s);
}
