// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include "fe_modal/body/skew.h"
#include "geometry/foundation/error.h"
#include "geometry/foundation/names.h"
#include "geometry/foundation/output_file.h"
#include "multibody/model/model.h"
#include "multibody/model/stress_stiffening.h"

namespace flexneck::multibody {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Relative tolerance of every comparison that rounding may affect: unit lengths, symmetry,
/// triangles.
constexpr double kSlack = 1e-9;
/// Tolerance of the mass normalisation of a file's modes, the same as that of kModalBodyFormat's
/// reader.
constexpr double kMassNormalisation = 1e-6;

[[noreturn]] void refuse(const std::string& who, const std::string& problem) {
  throw InputError(who + ": " + problem);
}

template <class Derived>
void check_finite(const std::string& who, const std::string& what,
                  const Eigen::MatrixBase<Derived>& values) {
  if (!values.allFinite()) refuse(who, what + " is not finite");
}

void check_unit_vector(const std::string& who, const std::string& what, const Vector3d& vector) {
  if (!(std::abs(vector.norm() - 1) <= kSlack)) {
    refuse(who, what + " must be a unit vector, but its length is " + rounded_text(vector.norm()));
  }
}

void check_rotation(const std::string& who, const Eigen::Quaterniond& rotation) {
  if (!(std::abs(rotation.norm() - 1) <= kSlack)) {
    refuse(who, "rotation must be a unit quaternion, but its length is " +
                    rounded_text(rotation.norm()));
  }
}

void check_mass(const std::string& who, double mass_kg) {
  if (!(mass_kg > 0) || !std::isfinite(mass_kg)) {
    refuse(who, "mass must be positive, not " + rounded_text(mass_kg) + " kg");
  }
}

/// Checks an inertia about the centre of mass. Equality in the triangle inequality is a flat body
/// and allowed, and so are moments of zero (massless_rotation.h).
void check_inertia(const std::string& who, const Matrix3d& inertia) {
  check_finite(who, "inertia", inertia);
  if ((inertia - inertia.transpose()).cwiseAbs().maxCoeff() >
      kSlack * inertia.cwiseAbs().maxCoeff()) {
    refuse(who, "inertia must be symmetric");
  }
  const Vector3d moments =
      Eigen::SelfAdjointEigenSolver<Matrix3d>(inertia, Eigen::EigenvaluesOnly).eigenvalues();
  const std::string listed =
      rounded_text(moments[0]) + ", " + rounded_text(moments[1]) + ", " + rounded_text(moments[2]);
  if (!(moments[0] >= -kSlack * moments[2])) {
    refuse(who,
           "no principal moment of inertia may be negative, but they are " + listed + " kg m^2");
  }
  if (moments[2] * (1 - kSlack) > moments[0] + moments[1]) {
    refuse(who, "the principal moments of inertia are physically impossible: " + listed +
                    " kg m^2, the largest exceeds the sum of the others; check that they are about "
                    "the centre of mass and in the same unit");
  }
}

void check_kind(const std::string& who, const RigidBody& rigid) {
  check_mass(who, rigid.mass_kg);
  check_finite(who, "centre of mass", rigid.center_m);
  check_inertia(who, rigid.inertia_kg_m2);
}

void check_shapes(const std::string& who, const fe_modal::ModalBody& modes) {
  const Eigen::Index m = modes.mode_count();
  const auto count = static_cast<std::size_t>(m);
  const fe_modal::InertiaInvariants& inv = modes.invariants;
  const bool sound = modes.modes.size() == count && inv.S2.cols() == m && inv.N0.cols() == m &&
                     inv.G0.size() == count && inv.G.size() == count * count &&
                     inv.N.size() == count * count && inv.Maa.rows() == m && inv.Maa.cols() == m;
  if (!sound)
    refuse(who, "its inertia invariants do not have the sizes for " + std::to_string(m) + " modes");
  for (const fe_modal::Interface& each : modes.interfaces) {
    if (each.translation.cols() != m || each.rotation.cols() != m) {
      refuse(who, "interface '" + each.name + "' does not have the shapes of " + std::to_string(m) +
                      " modes");
    }
    check_finite(who, "interface '" + each.name + "'", each.position_m);
    check_finite(who, "interface '" + each.name + "'", each.translation);
    check_finite(who, "interface '" + each.name + "'", each.rotation);
  }
}

/// Mass matrix of the undeformed body at rest in its frame (equations.md section 2).
Eigen::MatrixXd mass_matrix(const fe_modal::InertiaInvariants& inv) {
  const Eigen::Index m = inv.S2.cols();
  const Matrix3d crossed = skew(inv.S1);
  Eigen::MatrixXd mass(6 + m, 6 + m);
  mass << inv.mass * Matrix3d::Identity(), -crossed, inv.S2,  //
      crossed, inv.J0, inv.N0,                                //
      inv.S2.transpose(), inv.N0.transpose(), inv.Maa;
  return mass;
}

void check_invariants(const std::string& who, const fe_modal::InertiaInvariants& inv) {
  check_mass(who, inv.mass);
  const Eigen::Index m = inv.S2.cols();
  const Eigen::MatrixXd mass = mass_matrix(inv);
  check_finite(who, "inertia invariants", mass);
  if (m > 0) {
    const double deviation = (inv.Maa - Eigen::MatrixXd::Identity(m, m)).cwiseAbs().maxCoeff();
    if (deviation > kMassNormalisation) {
      refuse(who, "its modes are not mass-normalised: Maa differs from the identity by " +
                      rounded_text(deviation));
    }
  }
  // The modes of a body can never have more inertia than the body.
  if (Eigen::LLT<Eigen::MatrixXd>(mass).info() != Eigen::Success) {
    refuse(who,
           "its inertia invariants contradict each other: the mass matrix is not positive "
           "definite");
  }
}

void check_gaps(const std::string& who, const DeformableBody& deformable) {
  const SlitGaps& gaps = deformable.gaps;
  const Eigen::Index m = deformable.modes.mode_count();
  if (gaps.count() == 0 && gaps.coupling.size() == 0) return;
  if (gaps.stiffness.cols() != gaps.count() || gaps.coupling.rows() != gaps.count() ||
      gaps.coupling.cols() != m)
    refuse(who, "the stiffness and coupling of its gaps do not have the sizes for " +
                    std::to_string(gaps.count()) + " gaps and its modes");
  check_finite(who, "stiffness of its gaps", gaps.stiffness);
  check_finite(who, "coupling of its gaps", gaps.coupling);
  Eigen::MatrixXd all(m + gaps.count(), m + gaps.count());
  const Eigen::VectorXd omega = 2 * std::numbers::pi * deformable.modes.frequencies_Hz;
  all << omega.cwiseAbs2().asDiagonal().toDenseMatrix(), gaps.coupling.transpose(), gaps.coupling,
      gaps.stiffness;
  if (Eigen::LLT<Eigen::MatrixXd>(all).info() != Eigen::Success)
    refuse(who, "the stiffness of its modes and gaps is not positive definite");
  if (deformable.stress_stiffening)
    refuse(who, "stress_stiffening is not supported with slits that open and close");
}

void check_kind(const std::string& who, const DeformableBody& deformable) {
  const Eigen::Index m = deformable.modes.mode_count();
  check_shapes(who, deformable.modes);
  check_invariants(who, deformable.modes.invariants);
  if (!deformable.modes.prestress.empty())
    refuse(who, "its modes are prestressed by fixed loads (" + deformable.modes.prestress +
                    "), which would act twice here; make the modes without modes.prestress, or use "
                    "stress_stiffening, which follows the loads of the motion");
  if (!deformable.modes.slits.empty())
    refuse(who,
           "its slits would open and close without contact; use gap coordinates for their openings "
           "(fe_modal/body/gap_coordinates.h)");
  if (!deformable.modes.frequencies_Hz.allFinite() ||
      !(deformable.modes.frequencies_Hz.array() > 0).all()) {
    refuse(who, "its frequencies must be positive");
  }
  check_gaps(who, deformable);
  if (deformable.damping_ratio.size() != m) {
    refuse(who, "there must be one damping ratio per mode, " + std::to_string(m) +
                    ", but there are " + std::to_string(deformable.damping_ratio.size()));
  }
  const auto check_modal = [&](const std::string& what, const Eigen::VectorXd& values) {
    if (values.size() != 0 && values.size() != m)
      refuse(who, "its " + what + " must have one coordinate per mode, " + std::to_string(m) +
                      ", but has " + std::to_string(values.size()));
    check_finite(who, what, values);
  };
  check_modal("offset", deformable.offset);
  check_modal("initial modal coordinates", deformable.initial_modal);
  check_modal("initial modal rates", deformable.initial_modal_rate);
  check_stress_stiffening(who, deformable);
  for (Eigen::Index k = 0; k < m; ++k) {
    const double zeta = deformable.damping_ratio[k];
    if (!(zeta >= 0) || !std::isfinite(zeta)) {
      refuse(who, "damping ratio of mode '" +
                      deformable.modes.modes[static_cast<std::size_t>(k)].name +
                      "' must not be negative, but is " + rounded_text(zeta));
    }
  }
}

void check_kind(const std::string& who, const PrescribedBody& prescribed) {
  check_unit_vector(who, "direction of motion", prescribed.direction);
  if (!std::isfinite(prescribed.initial_velocity_m_s))
    refuse(who, "initial velocity is not finite");
  check_unit_vector(who, "axis of rotation", prescribed.turn.axis);
  check_finite(who, "point of rotation", prescribed.turn.point_m);
  if (!std::isfinite(prescribed.turn.initial_rate_rad_s))
    refuse(who, "initial rate of rotation is not finite");
}

void check_body(const Body& body) {
  const std::string who = "body '" + body.name + "'";
  std::visit([&](const auto& kind) { check_kind(who, kind); }, body.kind);
  check_finite(who, "initial position", body.initial_pose.position_m);
  check_rotation(who, body.initial_pose.rotation);
  check_finite(who, "initial velocity", body.initial_velocity_m_s);
  check_finite(who, "initial angular velocity", body.initial_angular_velocity_rad_s);
  const bool moves =
      !body.initial_velocity_m_s.isZero(0) || !body.initial_angular_velocity_rad_s.isZero(0);
  if (moves && std::holds_alternative<PrescribedBody>(body.kind)) {
    refuse(who, "its motion is prescribed, so that its velocity cannot be given as well");
  }
}

void check_index(const std::string& who, const std::string& kind, std::size_t index,
                 std::size_t count) {
  if (index >= count) {
    refuse(who, "there is no " + kind + " of index " + std::to_string(index) + ": there are " +
                    std::to_string(count));
  }
}

void check_marker(const Marker& marker, const Model& model) {
  const std::string who = "marker '" + marker.name + "'";
  check_index(who, "body", marker.body, model.bodies.size());
  check_finite(who, "position", marker.position_m);
  check_rotation(who, marker.rotation);
  const Body& body = model.bodies[marker.body];
  if (const auto* deformable = std::get_if<DeformableBody>(&body.kind)) {
    try {
      find_name(names_of(deformable->modes.interfaces), marker.interface, "interface");
    } catch (const InputError& error) {
      refuse(who, "on the deformable body '" + body.name + "' " + error.what());
    }
  } else if (!marker.interface.empty()) {
    refuse(who, "body '" + body.name + "' is not deformable and has no interface '" +
                    marker.interface + "'; give a position instead");
  }
}

void check_length(const std::string& who, const Joint& joint) {
  const JointLength& length = joint.kind->length;
  if (length.value == nullptr) return;
  const double value = joint.*length.value;
  if (std::isfinite(value) && (value > 0 || (value < 0 && length.may_be_negative))) return;
  refuse(who, std::string(length.key) + " must be " +
                  (length.may_be_negative ? "other than zero" : "positive") + ", but is " +
                  rounded_text(value) + " m");
}

void check_motors(const Joint& joint) {
  check_names(names_of(joint.motors), "motor");
  const auto demand = [&](JointCoordinate coordinate, bool has, const std::string& what) {
    const auto of = [&](const JointMotor& motor) { return motor.coordinate == coordinate; };
    const auto count = std::count_if(joint.motors.begin(), joint.motors.end(), of);
    if (count == 0) return;
    const std::string who =
        "motor '" + std::find_if(joint.motors.begin(), joint.motors.end(), of)->name + "'";
    if (!has)
      refuse(who, "joint '" + joint.name + "' is " + std::string(joint.kind->name) +
                      ", and a motor cannot prescribe its " + what);
    if (count > 1) refuse(who, "joint '" + joint.name + "' already has a motor for its " + what);
  };
  demand(JointCoordinate::distance, joint.kind->has_distance, "distance");
  demand(JointCoordinate::angle, joint.kind->has_angle, "angle");
  demand(JointCoordinate::flexion, false, "flexion");
}

void check_joint(const Joint& joint, const Model& model) {
  const std::string who = "joint '" + joint.name + "'";
  check_index(who, "marker", joint.marker_i, model.markers.size());
  check_index(who, "marker", joint.marker_j, model.markers.size());
  const std::size_t body_i = model.markers[joint.marker_i].body;
  const std::size_t body_j = model.markers[joint.marker_j].body;
  const Body& lower = model.bodies[body_i];
  const Body& upper = model.bodies[body_j];
  if (body_i == body_j) {
    refuse(who, "both markers are on body '" + lower.name + "'; a joint needs two bodies");
  }
  if (std::holds_alternative<PrescribedBody>(lower.kind) &&
      std::holds_alternative<PrescribedBody>(upper.kind)) {
    refuse(who, "it connects '" + lower.name + "' and '" + upper.name +
                    "', whose motions are both prescribed");
  }
  check_unit_vector(who, "axis", joint.axis);
  check_unit_vector(who, "second axis", joint.second_axis);
  check_length(who, joint);
  check_motors(joint);
}

void check_angle(const MeasuredAngle& angle, const Model& model) {
  const std::string who = "angle '" + angle.name + "'";
  check_index(who, "marker", angle.marker, model.markers.size());
  if (angle.relative_to) check_index(who, "marker", *angle.relative_to, model.markers.size());
  check_unit_vector(who, "axis", angle.axis);
}

ForceSites force_sites(const Model& model) {
  ForceSites sites{{}, model.joints};
  for (const Marker& marker : model.markers)
    sites.marker_bodies.push_back(model.bodies[marker.body].name);
  return sites;
}

}  // namespace

void check(const Model& model) {
  check_names(names_of(model.bodies), "body");
  check_names(names_of(model.markers), "marker");
  check_names(names_of(model.joints), "joint");
  check_finite("model", "gravity", model.gravity_m_s2);
  for (const Body& body : model.bodies) check_body(body);
  for (const Marker& marker : model.markers) check_marker(marker, model);
  for (const Joint& joint : model.joints) check_joint(joint, model);
  for (const MeasuredAngle& angle : model.angles) check_angle(angle, model);
  model.forces.check(force_sites(model));
}

}  // namespace flexneck::multibody
