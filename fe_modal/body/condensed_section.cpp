// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/body/condensed_section.h"

#include <numbers>

#include <Eigen/LU>

#include "fe_modal/body/skew.h"
#include "geometry/foundation/error.h"

namespace flexneck::fe_modal {
namespace {

using Matrix6d = Eigen::Matrix<double, 6, 6>;
using Matrix12d = Eigen::Matrix<double, 12, 12>;

constexpr double kDependent = 1e-9;

/// Motion of the point `to` of a rigid body whose point `from` has a motion.
Matrix6d carried(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  Matrix6d matrix = Matrix6d::Identity();
  matrix.topRightCorner<3, 3>() = -skew(to - from);
  return matrix;
}

/// Mass matrix of the undeformed body in [xdot; w; adot] of the body frame (equations.md,
/// section 2, at a = 0).
Matrix12d mass_in_body_frame(const InertiaInvariants& invariants) {
  Matrix12d mass = Matrix12d::Zero();
  mass.topLeftCorner<3, 3>() = invariants.mass * Eigen::Matrix3d::Identity();
  mass.block<3, 3>(0, 3) = -skew(invariants.S1);
  mass.block<3, 6>(0, 6) = invariants.S2;
  mass.block<3, 3>(3, 3) = invariants.J0;
  mass.block<3, 6>(3, 6) = invariants.N0;
  mass.block<6, 6>(6, 6) = invariants.Maa;
  return mass.selfadjointView<Eigen::Upper>();
}

/// What six modes are at the top: invertible, whatever the units of its rows.
Matrix6d modes_at_top(const ModalBody& body, const Interface& top, double length_m) {
  Matrix6d motion;
  motion << top.translation, top.rotation;
  Matrix6d scaled = motion;
  scaled.bottomRows<3>() *= length_m;
  for (Eigen::Index k = 0; k < 6; ++k) scaled.col(k) /= scaled.col(k).norm();
  const Eigen::FullPivLU<Matrix6d> pivots(scaled);
  if (!(pivots.rcond() > kDependent)) {
    throw InputError("the modes of a body with '" + body.boundary + "' do not move interface '" +
                     top.name +
                     "' in six independent ways; a section needs its static shapes alone");
  }
  return motion;
}

}  // namespace

CondensedSection condense(const ModalBody& body, const std::string& base, const std::string& top) {
  if (body.mode_count() != 6) {
    throw InputError(
        "a section between two faces has 6 modes, the static shapes of its top; found " +
        std::to_string(body.mode_count()));
  }
  const Interface& fixed = body.interface(base);
  const Interface& free = body.interface(top);
  CondensedSection section;
  section.base_m = fixed.position_m;
  section.top_m = free.position_m;

  // [frame; modes] from [base; top]: the frame rides on the base, and the modes are what the top
  // does beyond it.
  const double length = (section.top_m - section.base_m).norm();
  const Matrix6d from_top = modes_at_top(body, free, length).inverse();
  Matrix12d to_body = Matrix12d::Zero();
  to_body.topLeftCorner<6, 6>() = carried(section.base_m, Eigen::Vector3d::Zero());
  to_body.bottomLeftCorner<6, 6>() = -from_top * carried(section.base_m, section.top_m);
  to_body.bottomRightCorner<6, 6>() = from_top;

  const Eigen::Matrix<double, 6, 1> omega = 2 * std::numbers::pi * body.frequencies_Hz;
  const auto modes = to_body.bottomRows<6>();
  section.stiffness = modes.transpose() * omega.cwiseAbs2().asDiagonal() * modes;
  section.mass = to_body.transpose() * mass_in_body_frame(body.invariants) * to_body;
  return section;
}

}  // namespace flexneck::fe_modal
