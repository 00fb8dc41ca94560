// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/model/stress_stiffening.h"

#include <algorithm>

#include "geometry/foundation/error.h"

namespace flexneck::multibody {
namespace {

using Eigen::Index;
using fe_modal::GeometricStiffness;

/// Slopes of shapes by loads along x, y and z on the second-order displacements that are
/// M-orthogonal to the modes: the loads on all such displacements, `along`, less the modes' part in
/// them with `shapes` (3, m).
ShapeSlopes packed(const DeformableBody& body, const std::vector<Eigen::MatrixXd>& along,
                   double factor, const Eigen::Matrix3Xd& shapes) {
  const std::vector<Eigen::MatrixXd>& T = body.modes.geometric_stiffness->modal_acceleration;
  const Index m = shapes.cols();
  ShapeSlopes slopes(3 * m, m);
  for (Index i = 0; i < 3; ++i) {
    Eigen::MatrixXd slope = factor * along[static_cast<std::size_t>(i)];
    for (Index k = 0; k < m; ++k) slope -= shapes(i, k) * T[static_cast<std::size_t>(k)];
    for (Index l = 0; l < m; ++l) slopes.row(3 * l + i) = slope.row(l);
  }
  return slopes;
}

const GeometricStiffness::OfInterface* loads_on(const GeometricStiffness& stiffness,
                                                const std::string& interface) {
  const auto found = std::find_if(
      stiffness.interfaces.begin(), stiffness.interfaces.end(),
      [&](const GeometricStiffness::OfInterface& loads) { return loads.name == interface; });
  return found == stiffness.interfaces.end() ? nullptr : &*found;
}

bool moves(const fe_modal::Interface& interface) {
  return !(interface.translation.isZero(0) && interface.rotation.isZero(0));
}

/// Returns whether there are `count` finite symmetric matrices of m modes.
bool sound(const std::vector<Eigen::MatrixXd>& matrices, std::size_t count, Index m) {
  const auto is_sound = [m](const Eigen::MatrixXd& matrix) {
    return matrix.rows() == m && matrix.cols() == m && matrix.allFinite() &&
           (matrix - matrix.transpose()).cwiseAbs().maxCoeff() <=
               1e-9 * matrix.cwiseAbs().maxCoeff();
  };
  return matrices.size() == count && std::all_of(matrices.begin(), matrices.end(), is_sound);
}

}  // namespace

InertiaSlopes inertia_slopes(const DeformableBody& body) {
  if (!body.stress_stiffening) return {};
  const GeometricStiffness& stiffness = *body.modes.geometric_stiffness;
  const fe_modal::InertiaInvariants& invariants = body.modes.invariants;
  return {packed(body, stiffness.acceleration, 1, invariants.S2),
          packed(body, stiffness.angular_acceleration, 1, invariants.N0)};
}

Eigen::Matrix3d inertia_curvature(const DeformableBody& body, Index j, Index l) {
  Eigen::Matrix3d curvature = Eigen::Matrix3d::Zero();
  if (!body.stress_stiffening) return curvature;
  const GeometricStiffness& stiffness = *body.modes.geometric_stiffness;
  const std::vector<Eigen::MatrixXd>& products = stiffness.velocity_products;
  const double xy = products[3](j, l) / 2;
  const double xz = products[4](j, l) / 2;
  const double yz = products[5](j, l) / 2;
  curvature << products[0](j, l), xy, xz, xy, products[1](j, l), yz, xz, yz, products[2](j, l);
  for (std::size_t k = 0; k < stiffness.modal_acceleration.size(); ++k) {
    const Eigen::Matrix3d& G0 = body.modes.invariants.G0[k];
    curvature += stiffness.modal_acceleration[k](j, l) / 2 * (G0 + G0.transpose());
  }
  return -curvature;
}

NodeSlopes node_slopes(const DeformableBody& body, const std::string& interface) {
  if (!body.stress_stiffening) return {};
  const fe_modal::Interface& place = body.modes.interface(interface);
  if (!moves(place)) return {};
  const auto* loads = loads_on(*body.modes.geometric_stiffness, interface);
  return {packed(body, loads->force, -1, place.translation),
          packed(body, loads->moment, -1, place.rotation)};
}

Eigen::MatrixXd modal_curvatures(const DeformableBody& body) {
  if (!body.stress_stiffening) return {};
  const Index m = body.modes.mode_count();
  Eigen::MatrixXd curvatures(m * m, m);
  for (Index k = 0; k < m; ++k)
    curvatures.middleRows(m * k, m) =
        body.modes.geometric_stiffness->modal_acceleration[static_cast<std::size_t>(k)];
  return curvatures;
}

void check_stress_stiffening(const std::string& who, const DeformableBody& body) {
  if (!body.stress_stiffening) return;
  if (!body.modes.geometric_stiffness)
    throw InputError(who +
                     ": stress_stiffening needs the geometric stiffness of the modes, which the "
                     "modes file lacks; make it again with stress_stiffening = \"unit-loads\" in "
                     "the [modes] of its study");
  const GeometricStiffness& stiffness = *body.modes.geometric_stiffness;
  const Index m = body.modes.mode_count();
  const auto require = [&](bool is_sound, const std::string& what) {
    if (!is_sound)
      throw InputError(who + ": the geometric stiffness " + what +
                       " does not consist of finite symmetric matrices for " + std::to_string(m) +
                       " modes");
  };
  require(sound(stiffness.acceleration, 3, m), "for accelerations");
  require(sound(stiffness.angular_acceleration, 3, m), "for angular accelerations");
  require(sound(stiffness.velocity_products, 6, m), "for products of angular velocities");
  require(sound(stiffness.modal_acceleration, static_cast<std::size_t>(m), m),
          "for accelerations of the modes");
  for (const fe_modal::Interface& interface : body.modes.interfaces) {
    if (!moves(interface)) continue;
    const auto* loads = loads_on(stiffness, interface.name);
    if (loads == nullptr)
      throw InputError(who + ": there is no geometric stiffness for loads on interface '" +
                       interface.name + "'");
    require(sound(loads->force, 3, m) && sound(loads->moment, 3, m),
            "for loads on interface '" + interface.name + "'");
  }
}

}  // namespace flexneck::multibody
