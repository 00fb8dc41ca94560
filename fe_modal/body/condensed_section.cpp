// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/body/condensed_section.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "fe_modal/body/skew.h"
#include "geometry/foundation/error.h"

namespace flexneck::fe_modal {
namespace {

using Matrix6d = Eigen::Matrix<double, 6, 6>;
using Eigen::MatrixXd;

constexpr double kDependent = 1e-9;

/// Map from the motion of the point `from` of a rigid body to that of its point `to`.
Matrix6d carried(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  Matrix6d matrix = Matrix6d::Identity();
  matrix.topRightCorner<3, 3>() = -skew(to - from);
  return matrix;
}

/// Mass matrix of the undeformed body in [xdot; w; adot] of the body frame (equations.md,
/// section 2, at a = 0).
MatrixXd mass_in_body_frame(const InertiaInvariants& invariants) {
  const Eigen::Index m = invariants.Maa.rows();
  MatrixXd mass = MatrixXd::Zero(6 + m, 6 + m);
  mass.topLeftCorner<3, 3>() = invariants.mass * Eigen::Matrix3d::Identity();
  mass.block<3, 3>(0, 3) = -skew(invariants.S1);
  mass.block(0, 6, 3, m) = invariants.S2;
  mass.block<3, 3>(3, 3) = invariants.J0;
  mass.block(3, 6, 3, m) = invariants.N0;
  mass.bottomRightCorner(m, m) = invariants.Maa;
  return mass.selfadjointView<Eigen::Upper>();
}

/// Motions of the modes at the top and in the slits, openings first.
MatrixXd motions_of_modes(const ModalBody& body, const Interface& top) {
  const Eigen::Index m = body.mode_count();
  MatrixXd motions(m, m);
  motions.topRows<3>() = top.translation;
  motions.middleRows<3>(3) = top.rotation;
  Eigen::Index row = 6;
  for (const bool opens : {true, false})
    for (const SlitMotion& slit : body.slits)
      if (slit.opens == opens) motions.row(row++) = slit.amplitude;
  return motions;
}

/// Checks that the modes move the top and the slits independently.
/// @param length_m  scales rotations to lengths
void check_independent(const ModalBody& body, const Interface& top, MatrixXd motions,
                       double length_m) {
  motions.middleRows<3>(3) *= length_m;
  for (Eigen::Index k = 0; k < motions.cols(); ++k) motions.col(k).normalize();
  const Eigen::FullPivLU<MatrixXd> pivots(motions);
  if (pivots.rcond() > kDependent) return;
  throw InputError("the modes of the body with boundary condition '" + body.boundary +
                   "' do not move interface '" + top.name +
                   "' and its slits independently in all degrees of freedom; a section needs "
                   "exactly the static shapes of that interface");
}

/// Map from the other coordinates to all, with the last `count` ones, on which no load acts,
/// condensed.
MatrixXd without_load(const MatrixXd& stiffness, Eigen::Index count) {
  const Eigen::Index kept = stiffness.rows() - count;
  MatrixXd all = MatrixXd::Identity(stiffness.rows(), kept);
  if (count > 0)
    all.bottomRows(count) = -stiffness.bottomRightCorner(count, count)
                                 .llt()
                                 .solve(stiffness.bottomLeftCorner(count, kept));
  return all;
}

/// Checks that one slit slides.
/// @throws InputError unless there is sliding, and in one slit only: names are those of
/// slit_fields().
void check_one_sliding_slit(const ModalBody& body) {
  std::set<std::string> slits;
  bool slides = false;
  for (const SlitMotion& motion : body.slits) {
    slits.insert(motion.name.substr(0, motion.name.rfind(motion.opens ? " opens" : " slides")));
    slides = slides || !motion.opens;
  }
  if (!slides)
    throw InputError("slit_friction needs modes made with slits = \"openings-and-sliding\"");
  if (slits.size() > 1)
    throw InputError("friction is supported for one slit per section, found " +
                     std::to_string(slits.size()) +
                     " slits; divide the section into substructures with one slit each");
}

}  // namespace

CondensedSection condense(const ModalBody& body, const std::string& base, const std::string& top,
                          Sliding sliding) {
  if (!body.prestress.empty())
    throw InputError("a section needs modes without prestress, found modes prestressed by " +
                     body.prestress + "; make the modes without modes.prestress");
  const Eigen::Index m = body.mode_count();
  const auto slits = static_cast<Eigen::Index>(body.slits.size());
  if (m != 6 + slits) {
    throw InputError("a section between two faces needs " + std::to_string(6 + slits) +
                     " modes, the static shapes of its top and of its slits; found " +
                     std::to_string(m));
  }
  const Interface& fixed = body.interface(base);
  const Interface& free = body.interface(top);
  CondensedSection section;
  section.base_m = fixed.position_m;
  section.top_m = free.position_m;

  // Map from [base; top; slits] to [frame; modes]: the frame moves with the base, and the modes
  // give the motions of the top and the slits relative to it.
  const MatrixXd motions = motions_of_modes(body, free);
  check_independent(body, free, motions, (section.top_m - section.base_m).norm());
  const MatrixXd modes_from = motions.inverse();
  MatrixXd to_body = MatrixXd::Zero(6 + m, 6 + m);
  to_body.topLeftCorner<6, 6>() = carried(section.base_m, Eigen::Vector3d::Zero());
  to_body.bottomLeftCorner(m, 6) =
      -modes_from.leftCols<6>() * carried(section.base_m, section.top_m);
  to_body.bottomRightCorner(m, m) = modes_from;

  const Eigen::VectorXd omega = 2 * std::numbers::pi * body.frequencies_Hz;
  const auto modes = to_body.bottomRows(m);
  const MatrixXd stiffness = modes.transpose() * omega.cwiseAbs2().asDiagonal() * modes;
  const Eigen::Index slides = std::count_if(body.slits.begin(), body.slits.end(),
                                            [](const SlitMotion& slit) { return !slit.opens; });
  if (sliding == Sliding::kept) {
    section.slides = slides;
    check_one_sliding_slit(body);
  }
  const MatrixXd condensed = without_load(stiffness, slides - section.slides);
  section.stiffness = condensed.transpose() * stiffness * condensed;
  const MatrixXd shut = to_body * condensed.leftCols<12>();
  section.mass = shut.transpose() * mass_in_body_frame(body.invariants) * shut;
  return section;
}

double warp_of_face(const ModalBody& body, const std::string& interface,
                    const std::vector<Eigen::Index>& nodes) {
  const Interface& face = body.interface(interface);
  const MatrixXd motions = motions_of_modes(body, face);
  check_independent(body, face, motions, 1);
  const MatrixXd amplitudes = motions.inverse().leftCols<6>();
  double largest = 0;
  for (Eigen::Index way = 0; way < 6; ++way) {
    double apart = 0;
    double whole = 0;
    for (const Eigen::Index node : nodes) {
      Eigen::Vector3d moved = Eigen::Vector3d::Zero();
      for (Eigen::Index l = 0; l < body.mode_count(); ++l)
        moved += amplitudes(l, way) * body.shapes[static_cast<std::size_t>(l)].col(node);
      const Eigen::Vector3d rigid =
          carried(face.position_m, body.nodes_m.col(node)).topRows<3>().col(way);
      apart += (moved - rigid).squaredNorm();
      whole += rigid.squaredNorm();
    }
    largest = std::max(largest, std::sqrt(apart / whole));
  }
  return largest;
}

namespace {

/// Rigid-body part of a 6 x 6 mass matrix about a point.
LumpedMass rigid_part(const Matrix6d& mass) {
  const Eigen::Matrix3d moment = (mass.bottomLeftCorner<3, 3>() - mass.topRightCorner<3, 3>()) / 2;
  return {mass.topLeftCorner<3, 3>().trace() / 3,
          Eigen::Vector3d(moment(2, 1) - moment(1, 2), moment(0, 2) - moment(2, 0),
                          moment(1, 0) - moment(0, 1)) /
              2,
          mass.bottomRightCorner<3, 3>()};
}

/// The mass about a point at -p from its own.
LumpedMass moved(const LumpedMass& mass, const Eigen::Vector3d& p) {
  const Eigen::Matrix3d cross = skew(p) * skew(mass.first_moment_kg_m);
  return {mass.mass_kg, mass.first_moment_kg_m + mass.mass_kg * p,
          mass.inertia_kg_m2 - cross - cross.transpose() - mass.mass_kg * skew(p) * skew(p)};
}

}  // namespace

std::array<LumpedMass, 2> lumped_masses(const CondensedSection& section) {
  const Eigen::Vector3d to_top = section.top_m - section.base_m;
  const Matrix6d there = carried(section.base_m, section.top_m);
  const Matrix6d back = carried(section.top_m, section.base_m);
  const Matrix6d base_and_top = section.mass.topRightCorner<6, 6>() * there;
  const Matrix6d shared = (base_and_top + base_and_top.transpose()) / 2;
  const Matrix6d at_base = section.mass.topLeftCorner<6, 6>() + shared;
  const Matrix6d of_top =
      there.transpose() * section.mass.bottomRightCorner<6, 6>() * there + shared;
  LumpedMass base = rigid_part(at_base);
  LumpedMass top = rigid_part(back.transpose() * of_top * back);
  // Mass matrices of the ends have different masses along and across the axis, unlike rigid bodies:
  // each end takes half of the moments of inertia of the whole that this loses.
  const LumpedMass whole = rigid_part(at_base + of_top);
  const Eigen::Vector3d moment =
      whole.first_moment_kg_m - base.first_moment_kg_m - moved(top, to_top).first_moment_kg_m;
  base.first_moment_kg_m += moment / 2;
  top.first_moment_kg_m += moment / 2;
  const Eigen::Matrix3d inertia =
      whole.inertia_kg_m2 - base.inertia_kg_m2 - moved(top, to_top).inertia_kg_m2;
  base.inertia_kg_m2 += inertia / 2;
  top.inertia_kg_m2 += inertia / 2;
  return {base, top};
}

}  // namespace flexneck::fe_modal
