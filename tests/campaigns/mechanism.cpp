// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/campaigns/mechanism.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "multibody/joints/joint_kinds.h"
#include "tests/campaigns/draws.h"

namespace flexneck::campaigns {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using multibody::JointKind;

/// A random unit vector perpendicular to an axis.
Vector3d across(Case& drawn, const Vector3d& axis) {
  return axis.cross(direction(drawn)).normalized();
}

int freedoms_of(const std::string& kind) {
  return kind == "free"       ? 6
         : kind == "distance" ? 5
                              : static_cast<int>(kind_of(kind).motion->rates);
}

/// Draws a tree of bodies, with parallel joints if it is planar, and closes loops.
struct Draft {
  explicit Draft(Case& random) : drawn(random), normal(direction(random)) {
    made.gravity_m_s2 =
        drawn.chance(0.9) ? Vector3d(drawn.between(0, 9.81) * direction(drawn)) : Vector3d::Zero();
    made.links.emplace_back();
    made.end_s = drawn.between(0.5, 2);
    made.is_planar = drawn.chance(0.2);
    const bool is_chain = drawn.chance(0.3);
    for (int count = drawn.whole(3, 12); count > 0; --count) hang(is_chain);
    if (made.is_planar || drawn.chance(0.4))
      for (int count = drawn.whole(1, 2); count > 0; --count) close();
    for (int struts = drawn.whole(0, 3); struts > 0; --struts) brace();
  }

  Link& link(std::size_t k) { return made.links[k]; }
  std::size_t any_link() {
    return static_cast<std::size_t>(drawn.whole(0, static_cast<int>(made.links.size()) - 1));
  }
  Vector3d offset(double size_m) {
    const Vector3d found = size_m * direction(drawn);
    return made.is_planar ? Vector3d(found - found.dot(normal) * normal) : found;
  }

  void aim(Connection& c) {
    c.axis = !made.is_planar         ? direction(drawn)
             : c.kind == "prismatic" ? across(drawn, normal)
                                     : normal;
    c.second_axis = across(drawn, c.axis);
  }

  void hang(bool is_chain) {
    static const std::array kKinds = {"revolute",    "revolute",  "spherical", "universal",
                                      "cylindrical", "prismatic", "planar",    "screw",
                                      "fixed",       "free"};
    const std::size_t last = made.links.size() - 1;
    Connection c;
    c.inner = is_chain ? last : any_link();
    c.outer = last + 1;
    c.kind = kKinds[static_cast<std::size_t>(drawn.whole(0, 9))];
    if (c.kind == "free" && c.inner != 0) c.kind = "revolute";
    if (made.is_planar) c.kind = drawn.chance(0.85) ? "revolute" : "prismatic";
    aim(c);
    c.point_m = link(c.inner).position_m + offset(drawn.between(0.1, 0.5));
    c.outer_point_m = c.point_m;
    const JointKind& kind = kind_of(c.kind);
    double angle = kind.has_angle ? drawn.between(-1, 1) : 0;
    if (kind.has_distance) c.outer_point_m += drawn.between(-0.2, 0.2) * c.axis;
    if (kind.advances) {
      c.lead_m = log_between(drawn, 0.05, 0.5) * (drawn.chance(0.5) ? 1 : -1);
      c.outer_point_m += c.lead_m * angle / (2 * EIGEN_PI) * c.axis;
    }
    c.turn = Eigen::AngleAxisd(angle, c.axis).toRotationMatrix();
    Link body;
    body.mass_kg = log_between(drawn, 0.2, 5);
    body.rotation = rotation(drawn);
    body.center_m = 0.1 * direction(drawn);
    const double reach = log_between(drawn, 0.05, 0.3);
    const Vector3d second =
        Vector3d(drawn.between(0.2, 1), drawn.between(0.2, 1), 1) * reach * reach;
    const Matrix3d axes = rotation(drawn);
    body.inertia_kg_m2 = axes *
                         (body.mass_kg * (second.sum() - second.array())).matrix().asDiagonal() *
                         axes.transpose();
    body.inertia_kg_m2 = (body.inertia_kg_m2 + body.inertia_kg_m2.transpose()).eval() / 2;
    body.position_m = c.outer_point_m + offset(drawn.between(0.1, 0.5));
    body.velocity_m_s = drawn.between(0, 2) * direction(drawn);
    body.angular_velocity_rad_s = drawn.between(0, 3) * direction(drawn);
    if ((kind.has_angle || kind.has_distance) && drawn.chance(0.3)) {
      c.stiffness = body.mass_kg * (kind.has_distance ? 1 : 0.1) * log_between(drawn, 1, 1e3);
      c.damping = 0.1 * drawn.between(0, 1) * c.stiffness / std::sqrt(c.stiffness / body.mass_kg);
    }
    made.links.push_back(body);
    made.connections.push_back(c);
  }

  /// Number of degrees of freedom of the joints between two bodies along the tree.
  int freedoms_between(std::size_t a, std::size_t b) const {
    int sum = 0;
    while (a != b) {
      std::size_t& outer = a > b ? a : b;
      sum += freedoms_of(made.connections[outer - 1].kind);
      outer = made.connections[outer - 1].inner;
    }
    return sum;
  }

  /// Closes a loop if its joints keep a freedom.
  void close() {
    static const std::array kKinds = {"distance",    "spherical", "revolute", "universal",
                                      "cylindrical", "planar",    "prismatic"};
    Connection c;
    c.closes_loop = true;
    c.inner = any_link();
    c.outer = any_link();
    const int freedoms = freedoms_between(c.inner, c.outer);
    c.kind = made.is_planar ? "revolute" : kKinds[static_cast<std::size_t>(drawn.whole(0, 6))];
    if (!made.is_planar && freedoms - 6 + freedoms_of(c.kind) < 1) c.kind = "distance";
    if (freedoms < (made.is_planar ? 3 : 2)) return;
    aim(c);
    c.point_m = (link(c.inner).position_m + link(c.outer).position_m) / 2 + offset(0.3);
    c.outer_point_m = c.point_m;
    if (c.kind == "distance") c.outer_point_m += 0.4 * direction(drawn);
    made.connections.push_back(c);
  }

  void brace() {
    Strut s;
    s.first = any_link();
    s.second = any_link();
    if (s.first == s.second) return;
    s.first_point_m = link(s.first).position_m + 0.2 * direction(drawn);
    s.second_point_m = link(s.second).position_m + 0.2 * direction(drawn);
    s.stiffness = log_between(drawn, 1, 1e3);
    s.damping = drawn.between(0, 0.05) * s.stiffness;
    s.free_length_m = drawn.between(0.3, 1) * (s.second_point_m - s.first_point_m).norm();
    s.is_bushing = drawn.chance(0.4);
    if (s.is_bushing && drawn.chance(0.3)) s.turning_stiffness = log_between(drawn, 0.1, 10);
    made.struts.push_back(s);
  }

  Case& drawn;
  Vector3d normal;
  Mechanism made;
};

}  // namespace

Matrix3d rotation(Case& drawn) {
  return Eigen::AngleAxisd(drawn.between(-3, 3), direction(drawn)).toRotationMatrix();
}

const multibody::JointKind& kind_of(const std::string& name) {
  return **std::find_if(multibody::kJointKinds.begin(), multibody::kJointKinds.end(),
                        [&](const multibody::JointKind* kind) { return kind->name == name; });
}

Mechanism random_mechanism(Case& drawn) { return Draft(drawn).made; }

}  // namespace flexneck::campaigns
