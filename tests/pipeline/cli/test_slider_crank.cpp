// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <string>

#include <Eigen/Eigenvalues>
#include <catch2/catch.hpp>
#include <fmt/core.h>

#include "fe_modal/body/modal_body_file.h"
#include "fe_modal/exchange/reduced_body.h"
#include "geometry/foundation/output_file.h"
#include "tests/support/model_reading.h"
#include "tests/support/model_text.h"

namespace flexneck::pipeline {
namespace {

using Eigen::Matrix4d;
using Eigen::Vector4d;

std::string list_of(const Vector4d& values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "[" : ", ") + exact_text(value);
  return text + "]";
}

/// The connecting rod of the flexible slider-crank of B. Simeon (test set for initial value problem
/// solvers, problem "crank"): two modes along y, two along x, with the published matrices, whose
/// longitudinal masses lack a factor 1/15.
struct Rod {
  static constexpr double kPi = 3.1415927;  // as published
  static constexpr double L = 0.3, b = 0.008, E = 2e11, rho = 7870;
  static constexpr double kMass = 0.151104, kInertia = 0.0045339259;

  Matrix4d mass, stiffness;
  fe_modal::ReducedBody reduced;

  Rod() {
    const double Fb = b * b * L, Fm = rho * Fb, Fk = E * b * b / L;
    mass = Vector4d(Fm / 2, Fm / 2, 8 * Fm, 2 * Fm).asDiagonal();
    mass(2, 3) = mass(3, 2) = Fm;
    const double bending = Fk * std::pow(kPi, 4) * (b / L) * (b / L);
    stiffness = Vector4d(bending / 24, bending * 2 / 3, Fk * 16 / 3, Fk * 7 / 3).asDiagonal();
    stiffness(2, 3) = stiffness(3, 2) = -Fk * 8 / 3;
    Matrix4d B = Matrix4d::Zero();
    B(0, 2) = -16 * Fb / std::pow(kPi, 3);
    B(0, 3) = Fb * (8 / std::pow(kPi, 3) - 1 / kPi);
    B(1, 3) = Fb / (2 * kPi);
    B -= B.transpose().eval();
    const Vector4d c1 = rho * Fb * Vector4d(0, 0, 2. / 3, 1. / 6);
    const Vector4d c2 = rho * Fb * Vector4d(2 / kPi, 0, 0, 0);
    const Vector4d c12 = rho * Fb * L * Vector4d(0, 0, 1. / 3, 1. / 6);
    const Vector4d c21 = rho * Fb * L * Vector4d(1 / kPi, -1 / (2 * kPi), 0, 0);
    fe_modal::InertiaInvariants& inertia = reduced.invariants;
    inertia.mass = kMass;
    inertia.S1 = {kMass * L / 2, 0, 0};
    const double across = kMass * b * b / 12;
    inertia.J0 = Eigen::Vector3d(2 * across, kInertia, kInertia).asDiagonal();
    inertia.S2.setZero(3, 4);
    inertia.S2.row(0) = c1;
    inertia.S2.row(1) = c2;
    inertia.N0.setZero(3, 4);
    inertia.N0.row(2) = c21;
    inertia.Maa = mass;
    // -int rho ~p ~q = int rho ((p.q) 1 - q p^T), for fields along x and along y.
    for (Eigen::Index j = 0; j < 4; ++j) {
      Eigen::Matrix3d G0 = Eigen::Vector3d(0, c12[j], c12[j]).asDiagonal();
      G0(1, 0) = -c21[j];
      inertia.G0.push_back(G0);
      for (Eigen::Index l = 0; l < 4; ++l) {
        const double n = rho * B(j, l);
        Eigen::Matrix3d G =
            Eigen::Vector3d(j < 2 ? mass(j, l) : 0, j < 2 ? 0 : mass(j, l), mass(j, l))
                .asDiagonal();
        if (j < 2 && l >= 2) G(0, 1) = n;
        if (j >= 2 && l < 2) G(1, 0) = -n;
        inertia.G.push_back(G);
        inertia.N.emplace_back(0, 0, n);
      }
    }
    reduced.stiffness = stiffness;
    reduced.damping = Matrix4d::Zero();
    const Eigen::Matrix3Xd none = Eigen::Matrix3Xd::Zero(3, 4);
    Eigen::Matrix3Xd along = none;
    along(0, 3) = 1;
    reduced.nodes = {{"start", Eigen::Vector3d::Zero(), none, none},
                     {"end", Eigen::Vector3d(L, 0, 0), along, none}};
  }
};

/// Crank, rod and sliding mass, with the published state at time zero.
std::string slider_crank_text(const Vector4d& modal, const Vector4d& modal_rate,
                              const std::string& formulation) {
  return fmt::format(R"(
[solver]
end_time = "0.1 s"
relative_tolerance = 1e-10
absolute_tolerance = 1e-13
formulation = "{}"
[output]
interval = "0.1 s"
[[body]]
name = "ground"
kind = "ground"
[[body]]
name = "crank"
kind = "prescribed"
[body.turn]
axis = [0, 0, 1]
initial_rate = "150 rad/s"
[[body]]
name = "rod"
kind = "deformable"
modes_file = "rod.h5"
damping_ratio = 0
position = ["0.15 m", "0 m", "0 m"]
velocity = ["0 m/s", "22.5 m/s", "0 m/s"]
angular_velocity = ["0 rad/s", "0 rad/s", "-74.9957670 rad/s"]
modal_coordinates = {}
modal_rates = {}
[[body]]
name = "slider"
kind = "rigid"
mass = "0.075552 kg"
center = ["0 m", "0 m", "0 m"]
inertia = ["0 kg*m^2", "0 kg*m^2", "0 kg*m^2"]
position = ["0.450016933 m", "0 m", "0 m"]
velocity = ["-2.68938672e-6 m/s", "0 m/s", "0 m/s"]
[[marker]]
body = "crank"
name = "pin"
position = ["0.15 m", "0 m", "0 m"]
[[joint]]
name = "crank pin"
kind = "revolute"
lower = "crank.pin"
upper = "rod.start"
axis = [0, 0, 1]
[[joint]]
name = "piston pin"
kind = "spherical"
lower = "rod.end"
upper = "slider.pin"
[[joint]]
name = "guide"
kind = "prismatic"
lower = "ground.guide"
upper = "slider.pin"
axis = [1, 0, 0]
)",
                     formulation, list_of(modal), list_of(modal_rate)) +
         testing::origin_marker_text("ground", "guide") +
         testing::origin_marker_text("slider", "pin");
}

}  // namespace

TEST_CASE("a flexible slider-crank started with its modal coordinates ends as published") {
  const TemporaryFolder folder;
  const Rod rod;
  const fe_modal::ModalBody body = fe_modal::import_modes(rod.reduced).body;
  fe_modal::write_modal_body(folder / "rod.h5", {body, {}});
  // q = T a with T^T M T = 1.
  const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix4d> modes(rod.stiffness, rod.mass);
  const Matrix4d T = modes.eigenvectors();
  REQUIRE((T.row(3) - body.interface("end").translation.row(0)).norm() < 1e-12);
  const Vector4d q(0, 0, 1.03339863e-5, 1.69327969e-5);
  const Vector4d q_rate(0.444896105, 4.63434311e-3, -1.78591076e-6, -2.68938672e-6);
  const Matrix4d to_modal = T.transpose() * rod.mass;
  const ModelFile file =
      testing::read_model(folder, slider_crank_text(to_modal * q, to_modal * q_rate, "automatic"));
  const multibody::History found = testing::run(file, true);
  const Eigen::Index end = found.time_s.size() - 1;
  const Vector4d at_end = T * found.modal[0].coordinates.col(end);
  const Eigen::Vector4d turn = found.marker("rod.start").rotation.col(end);
  const double angle = 2 * std::atan2(turn[3], turn[0]);
  const double place = found.marker("slider.pin").position_m(0, end);
  const double speed = found.marker("slider.pin").velocity_m_s(0, end);
  const double rate = found.state.bodies[0].angular_velocity_rad_s(2, end);
  INFO(fmt::format("errors: angle {:.1e}, place {:.1e}, rate {:.1e}, speed {:.1e}",
                   angle / -0.3311734987910881 - 1, place / 0.1697373326718410 - 1,
                   rate / 60.25346682645789 - 1, speed / -8.753116989887888 - 1));
  CHECK(std::remainder(angle + 0.3311734987910881, 2 * M_PI) ==
        Approx(0).margin(1e-6 * 0.3311734987910881));
  CHECK(place == Approx(0.1697373326718410).epsilon(1e-6));
  CHECK(rate == Approx(60.25346682645789).epsilon(1e-6));
  CHECK(speed == Approx(-8.753116989887888).epsilon(1e-6));
  const Vector4d published(1.893192460247178e-4, 2.375751865617931e-5, -5.323907988763734e-6,
                           -8.363283141616840e-6);
  INFO((at_end - published).transpose());
  CHECK((at_end - published).cwiseAbs().maxCoeff() < 1e-6 * published.maxCoeff());
}

}  // namespace flexneck::pipeline
