// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/beam_body.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>

#include "tests/support/point_mass_body.h"

namespace flexneck::testing {
namespace {

struct BeamMode {
  std::string name;
  double frequency_Hz;
  Eigen::Matrix3Xd shape;
  Eigen::Vector3d top_translation;
  Eigen::Vector3d top_rotation;
  std::size_t number = 0;                           ///< number of the bending mode along `along`
  Eigen::Vector3d along = Eigen::Vector3d::Zero();  ///< zero for twist
};

std::vector<BeamMode> beam_modes(const Beam& beam, const Eigen::Matrix3Xd& points) {
  std::vector<BeamMode> modes;
  const double unit = 1 / std::sqrt(beam.mass_kg);
  const double length = beam.length_m;
  // Bending along x rotates sections about +y, bending along y about -x.
  const auto add_bending = [&](const char* name, double first_Hz, int count,
                               const Eigen::Vector3d& along, const Eigen::Vector3d& about) {
    for (std::size_t n = 0; n < static_cast<std::size_t>(count); ++n) {
      BeamMode mode;
      mode.name = std::string(name) + " bending " + std::to_string(n + 1);
      mode.frequency_Hz = first_Hz * std::pow(kClampedFree[n] / kClampedFree[0], 2);
      mode.shape.resize(3, points.cols());
      for (Eigen::Index k = 0; k < points.cols(); ++k) {
        mode.shape.col(k) = unit * clamped_free_shape(n, points(2, k) / length).first * along;
      }
      const auto [top, slope] = clamped_free_shape(n, 1);
      mode.top_translation = unit * top * along;
      mode.top_rotation = unit * slope / length * about;
      mode.number = n;
      mode.along = along;
      modes.push_back(std::move(mode));
    }
  };
  add_bending("fore-aft", beam.fore_aft_Hz, beam.fore_aft_modes, Eigen::Vector3d::UnitX(),
              Eigen::Vector3d::UnitY());
  add_bending("lateral", beam.lateral_Hz, beam.lateral_modes, Eigen::Vector3d::UnitY(),
              -Eigen::Vector3d::UnitX());
  for (int n = 0; n < beam.twist_modes; ++n) {
    // Modal mass of sin: m r_p^2 / 2 with the polar radius of gyration r_p^2 = 2 gyration^2.
    const double amplitude = unit / beam.gyration_m;
    const double wave = (2 * n + 1) * std::numbers::pi / 2;
    BeamMode mode{"twist " + std::to_string(n + 1), beam.twist_Hz * (2 * n + 1), {}, {}, {}};
    mode.shape.resize(3, points.cols());
    for (Eigen::Index k = 0; k < points.cols(); ++k) {
      const double angle = amplitude * std::sin(wave * points(2, k) / length);
      mode.shape.col(k) = angle * Eigen::Vector3d(-points(1, k), points(0, k), 0);
    }
    mode.top_translation.setZero();
    mode.top_rotation = amplitude * std::sin(wave) * Eigen::Vector3d::UnitZ();
    modes.push_back(std::move(mode));
  }
  std::stable_sort(modes.begin(), modes.end(), [](const BeamMode& left, const BeamMode& right) {
    return left.frequency_Hz < right.frequency_Hz;
  });
  return modes;
}

/// Shortening of an inextensible beam by bending in two modes at once, up to a section at z:
/// int_0^z w_j' w_l' dz for each pair of modes.
Eigen::MatrixXd foreshortening(const Beam& beam, const std::vector<BeamMode>& modes, double z) {
  static const auto rule = gauss_rule(40);
  const auto count = static_cast<Eigen::Index>(modes.size());
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(count, count);
  Eigen::MatrixXd slopes(3, count);
  for (Eigen::Index k = 0; k < rule.first.size(); ++k) {
    for (Eigen::Index l = 0; l < count; ++l) {
      const BeamMode& mode = modes[static_cast<std::size_t>(l)];
      const double slope =
          clamped_free_shape(mode.number, rule.first[k] * z / beam.length_m).second;
      slopes.col(l) = slope / (beam.length_m * std::sqrt(beam.mass_kg)) * mode.along;
    }
    sum += rule.second[k] * z * slopes.transpose() * slopes;
  }
  return sum;
}

/// Geometric stiffness of bending only: twist and twisting moments do not contribute.
fe_modal::GeometricStiffness beam_stiffness(const Beam& beam, const std::vector<BeamMode>& modes,
                                            const Eigen::VectorXd& masses,
                                            const Eigen::Matrix3Xd& points) {
  const auto count = static_cast<Eigen::Index>(modes.size());
  std::vector<Eigen::Matrix3Xd> second(modes.size() * modes.size(),
                                       Eigen::Matrix3Xd::Zero(3, points.cols()));
  for (Eigen::Index k = 0; k < points.cols(); ++k) {
    const Eigen::MatrixXd drawn = foreshortening(beam, modes, points(2, k));
    for (Eigen::Index j = 0; j < count; ++j)
      for (Eigen::Index l = 0; l < count; ++l)
        second[static_cast<std::size_t>(j * count + l)](2, k) = -drawn(j, l);
  }
  std::vector<Eigen::Matrix3Xd> shapes;
  for (const BeamMode& mode : modes) shapes.push_back(mode.shape);
  fe_modal::GeometricStiffness stiffness =
      inertial_stiffness_of_points(masses, points, shapes, second);
  const Eigen::MatrixXd none = Eigen::MatrixXd::Zero(count, count);
  stiffness.interfaces = {
      {"top", {none, none, foreshortening(beam, modes, beam.length_m)}, {none, none, none}}};
  return stiffness;
}

}  // namespace

std::pair<double, double> clamped_free_shape(std::size_t n, double z) {
  const double x = kClampedFree[n];
  const double sigma = (std::cosh(x) + std::cos(x)) / (std::sinh(x) + std::sin(x));
  const double sign = n % 2 == 0 ? 1 : -1;
  const double u = x * z;
  return {sign * (std::cosh(u) - std::cos(u) - sigma * (std::sinh(u) - std::sin(u))),
          sign * x * (std::sinh(u) + std::sin(u) - sigma * (std::cosh(u) - std::cos(u)))};
}

std::pair<Eigen::VectorXd, Eigen::VectorXd> gauss_rule(Eigen::Index count) {
  Eigen::VectorXd off(count - 1);
  for (Eigen::Index k = 1; k < count; ++k) {
    const auto n = static_cast<double>(k);
    off[k - 1] = n / std::sqrt(4 * n * n - 1);
  }
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
  solver.computeFromTridiagonal(Eigen::VectorXd::Zero(count), off);
  return {(solver.eigenvalues().array() + 1) / 2, solver.eigenvectors().row(0).array().square()};
}

fe_modal::ModalBody make_beam_body(const Beam& beam) {
  constexpr Eigen::Index kStations = 40;
  const auto [stations, weights] = gauss_rule(kStations);
  Eigen::Matrix3Xd points(3, 4 * kStations);
  Eigen::VectorXd masses(4 * kStations);
  const double r = beam.gyration_m * std::numbers::sqrt2;
  for (Eigen::Index k = 0; k < kStations; ++k) {
    const double z = beam.length_m * stations[k];
    points.middleCols<4>(4 * k) << r, -r, 0, 0, 0, 0, r, -r, z, z, z, z;
    masses.segment<4>(4 * k).setConstant(beam.mass_kg * weights[k] / 4);
  }
  const std::vector<BeamMode> modes = beam_modes(beam, points);
  const auto count = static_cast<Eigen::Index>(modes.size());

  fe_modal::ModalBody body;
  body.nodes_m = points;
  body.boundary = "fixed: base";
  body.completeness = "closed form";
  body.frequencies_Hz.resize(count);
  const Eigen::Matrix3Xd none = Eigen::Matrix3Xd::Zero(3, count);
  fe_modal::Interface top{"top", {0, 0, beam.length_m}, none, none};
  for (Eigen::Index k = 0; k < count; ++k) {
    const BeamMode& mode = modes[static_cast<std::size_t>(k)];
    body.frequencies_Hz[k] = mode.frequency_Hz;
    body.modes.push_back({mode.name, "normal", {}, 0});
    body.shapes.push_back(mode.shape);
    top.translation.col(k) = mode.top_translation;
    top.rotation.col(k) = mode.top_rotation;
  }
  body.interfaces = {{"base", Eigen::Vector3d::Zero(), none, none}, top};
  body.invariants = invariants_of_points(masses, points, body.shapes);
  body.geometric_stiffness = beam_stiffness(beam, modes, masses, points);
  return body;
}

}  // namespace flexneck::testing
