// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "fe_modal/body/basis_table.h"
#include "fe_modal/body/mode_count_study.h"
#include "tests/support/beam_body.h"

namespace flexneck::fe_modal {
namespace {

constexpr double kMass = 1.2;
constexpr double kLength = 0.15;

/// A clamped-free beam with its textbook compliance at the tip in the plane of x and z, and along
/// y.
ModalBody beam() {
  testing::Beam beam;
  beam.mass_kg = kMass;
  beam.length_m = kLength;
  beam.fore_aft_modes = 4;
  ModalBody body = testing::make_beam_body(beam);
  const auto bending_stiffness = [&](double first_Hz) {
    return std::pow(2 * std::numbers::pi * first_Hz, 2) * kMass * std::pow(kLength, 3) /
           std::pow(testing::kClampedFree[0], 4);
  };
  StaticResponse response{Eigen::Matrix<double, 6, 6>::Identity(),
                          Eigen::Matrix<double, 6, 6>::Identity()};
  const double EI = bending_stiffness(beam.fore_aft_Hz);
  response.compliance(0, 0) = std::pow(kLength, 3) / (3 * EI);
  response.compliance(4, 4) = kLength / EI;
  response.compliance(1, 1) = std::pow(kLength, 3) / (3 * bending_stiffness(beam.lateral_Hz));
  body.interfaces.back().response = response;
  return body;
}

}  // namespace

TEST_CASE("effective masses of a cantilever are the textbook's shares") {
  // Blevins, Formulas for natural frequency and mode shape, has 0.6131, 0.1883, 0.0647, 0.0331.
  constexpr double kPrinted = 0.006;  // half of the last printed digit, in per cent
  const ModalBody body = beam();
  const BasisTable table = basis_table(body);
  double sum = 0;
  for (const auto& [name, share] : {std::pair{"fore-aft bending 1", 61.31},
                                    {"fore-aft bending 2", 18.83},
                                    {"fore-aft bending 3", 6.47},
                                    {"fore-aft bending 4", 3.31}}) {
    CAPTURE(name);
    const Eigen::Index k = body.mode_index(name);
    CHECK(std::abs(100 * table.effective_mass_kg(k, 0) / kMass - share) < kPrinted);
    CHECK(std::abs(table.effective_mass_kg(k, 1)) < 1e-12);
    sum += 100 * table.effective_mass_kg(k, 0) / kMass;
    CHECK(table.inertia_percent(k, 0) == Approx(sum).epsilon(1e-12));
  }
  // One mode rotates the beam about y through its root by (2 / 1.8751^2)^2 of m L^2.
  const double about_root = 4 / std::pow(testing::kClampedFree[0], 4);
  CHECK(table.effective_inertia_kg_m2(body.mode_index("fore-aft bending 1"), 1) ==
        Approx(about_root * kMass * kLength * kLength).epsilon(1e-9));
}

TEST_CASE("modes of a cantilever hold 12 / b^4 of its compliance under a tip force") {
  const ModalBody body = beam();
  const BasisTable table = basis_table(body);
  REQUIRE(table.compliance.size() == 1);
  CHECK(table.compliance[0].interface == "top");
  const Eigen::MatrixXd& percent = table.compliance[0].percent;
  double force = 0;
  double moment = 0;
  for (std::size_t n = 0; n < 4; ++n) {
    const double b = testing::kClampedFree[n];
    const double slope = testing::clamped_free_shape(n, 1).second;
    force += 100 * 12 / std::pow(b, 4);
    moment += 100 * slope * slope / std::pow(b, 4);
    const Eigen::Index k = body.mode_index("fore-aft bending " + std::to_string(n + 1));
    CHECK(percent(k, 0) == Approx(force).epsilon(1e-9));
    CHECK(percent(k, 4) == Approx(moment).epsilon(1e-9));
  }
  CHECK(force < 100);
  CHECK(force > 99.9);
}

TEST_CASE("a study of mode counts needs the mass matrix and the static response") {
  ModalBody body = beam();
  AttachedFrequencies attached{"head", "top", Eigen::VectorXd::Ones(1)};
  CHECK(mode_count_study(body, attached).empty());
  attached.mass_matrix = Eigen::Matrix<double, 6, 6>::Identity();
  body.interfaces.back().response.reset();
  CHECK(mode_count_study(body, attached).empty());
}

}  // namespace flexneck::fe_modal
