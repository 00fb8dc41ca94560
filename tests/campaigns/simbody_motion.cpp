// SPDX-License-Identifier: GPL-3.0-or-later
// A mechanism in Simbody: mobilizers for the joints of the tree, constraints for those of loops.
#include <Simbody.h>
#include <cmath>

#include "tests/campaigns/mechanism.h"

namespace flexneck::campaigns {
namespace {

using SimTK::MobilizedBody;
using SimTK::Rotation;
using SimTK::Transform;
using SimTK::UnitVec3;
using SimTK::Vec3;

Vec3 vec(const Eigen::Vector3d& v) { return {v[0], v[1], v[2]}; }

SimTK::Mat33 mat(const Eigen::Matrix3d& m) {
  return {m(0, 0), m(0, 1), m(0, 2), m(1, 0), m(1, 1), m(1, 2), m(2, 0), m(2, 1), m(2, 2)};
}

Rotation turn(const Eigen::Matrix3d& m) { return Rotation(mat(m)); }

SimTK::Body::Rigid rigid(const Link& link) {
  const Eigen::Vector3d& c = link.center_m;
  const Eigen::Matrix3d about_origin =
      link.inertia_kg_m2 +
      link.mass_kg * (c.dot(c) * Eigen::Matrix3d::Identity() - c * c.transpose());
  const Eigen::Matrix3d& i = about_origin;
  return SimTK::Body::Rigid(SimTK::MassProperties(
      link.mass_kg, vec(c), SimTK::Inertia(i(0, 0), i(1, 1), i(2, 2), i(0, 1), i(0, 2), i(1, 2))));
}

struct Twin {
  explicit Twin(const Mechanism& source) : mechanism(source) {
    bodies.push_back(matter.Ground());
    for (const Link& link : mechanism.links)
      places.emplace_back(turn(link.rotation), vec(link.position_m));
    for (const Connection& c : mechanism.connections)
      c.closes_loop ? close(c) : bodies.push_back(hang(c));
    for (const Strut& strut : mechanism.struts) add(strut);
  }

  Vec3 on(std::size_t body, const Eigen::Vector3d& point) const {
    return ~places[body] * vec(point);
  }
  UnitVec3 along(std::size_t body, const Eigen::Vector3d& axis) const {
    return UnitVec3(~places[body].R() * vec(axis));
  }

  /// The joint's frames, with z along its axis, or x for joints that Simbody has along x.
  std::array<Transform, 2> frames(const Connection& c) const {
    const bool is_x = c.kind == "prismatic" || c.kind == "universal";
    const UnitVec3 axis(vec(c.axis));
    const Rotation axes = is_x ? Rotation(axis, SimTK::XAxis, vec(c.second_axis), SimTK::YAxis)
                               : Rotation(axis, SimTK::ZAxis, vec(c.second_axis), SimTK::XAxis);
    return {~places[c.inner] * Transform(axes, vec(c.point_m)),
            ~places[c.outer] * Transform(turn(c.turn) * axes, vec(c.outer_point_m))};
  }

  MobilizedBody hang(const Connection& c) {
    const auto [F, M] = frames(c);
    MobilizedBody& parent = bodies[c.inner];
    const SimTK::Body::Rigid body = rigid(mechanism.links[c.outer]);
    MobilizedBody made;
    int coordinate = 0;
    if (c.kind == "revolute") {
      made = MobilizedBody::Pin(parent, F, body, M);
    } else if (c.kind == "prismatic") {
      made = MobilizedBody::Slider(parent, F, body, M);
    } else if (c.kind == "cylindrical") {
      made = MobilizedBody::Cylinder(parent, F, body, M);
      coordinate = 1;
    } else if (c.kind == "screw") {
      made = MobilizedBody::Screw(parent, F, body, M, c.lead_m / (2 * SimTK::Pi));
    } else if (c.kind == "planar") {
      made = MobilizedBody::Planar(parent, F, body, M);
    } else if (c.kind == "spherical") {
      made = MobilizedBody::Ball(parent, F, body, M);
    } else if (c.kind == "universal") {
      made = MobilizedBody::Universal(parent, F, body, M);
    } else if (c.kind == "fixed") {
      made = MobilizedBody::Weld(parent, F, body, M);
    } else {
      made = MobilizedBody::Free(parent, F, body, M);
    }
    if (c.stiffness > 0) {
      SimTK::Force::MobilityLinearSpring(forces, made, coordinate, c.stiffness, 0);
      SimTK::Force::MobilityLinearDamper(forces, made, coordinate, c.damping);
    }
    return made;
  }

  void close(const Connection& c) {
    MobilizedBody& i = bodies[c.inner];
    MobilizedBody& j = bodies[c.outer];
    const Vec3 at_i = on(c.inner, c.point_m);
    const Vec3 at_j = on(c.outer, c.outer_point_m);
    const UnitVec3 axis = along(c.inner, c.axis);
    if (c.kind == "distance") {
      SimTK::Constraint::Rod(i, at_i, j, at_j, (c.outer_point_m - c.point_m).norm());
    } else if (c.kind == "planar") {
      SimTK::Constraint::PointInPlane(i, axis, SimTK::dot(axis, at_i), j, at_j);
    } else if (c.kind == "cylindrical" || c.kind == "prismatic") {
      SimTK::Constraint::PointOnLine(i, axis, at_i, j, at_j);
    } else {
      SimTK::Constraint::Ball(i, at_i, j, at_j);
    }
    if (c.kind == "universal") {
      SimTK::Constraint::ConstantAngle(i, axis, j, along(c.outer, c.second_axis));
    } else if (c.kind == "prismatic") {
      SimTK::Constraint::ConstantOrientation(i, ~places[c.inner].R(), j, ~places[c.outer].R());
    } else if (c.kind == "planar" || c.kind == "cylindrical" || c.kind == "revolute") {
      SimTK::Constraint::ConstantAngle(i, axis, j, along(c.outer, c.second_axis));
      SimTK::Constraint::ConstantAngle(i, axis, j, along(c.outer, c.axis.cross(c.second_axis)));
    }
  }

  void add(const Strut& s) {
    const Vec3 first = on(s.first, s.first_point_m);
    const Vec3 second = on(s.second, s.second_point_m);
    if (s.is_bushing) {
      const SimTK::Vec6 along_axes(0, 0, 0, 1, 1, 1);
      SimTK::Force::LinearBushing(forces, bodies[s.first], Transform(~places[s.first].R(), first),
                                  bodies[s.second], Transform(~places[s.second].R(), second),
                                  s.stiffness * along_axes, s.damping * along_axes);
      return;
    }
    SimTK::Force::TwoPointLinearSpring(forces, bodies[s.first], first, bodies[s.second], second,
                                       s.stiffness, s.free_length_m);
    SimTK::Force::TwoPointLinearDamper(forces, bodies[s.first], first, bodies[s.second], second,
                                       s.damping);
  }

  /// The initial state, in the coordinates of each mobilizer.
  SimTK::State start() {
    SimTK::State state = system.realizeTopology();
    system.realizeModel(state);
    std::size_t body = 1;
    for (const Connection& c : mechanism.connections) {
      if (c.closes_loop) continue;
      const auto [F, M] = frames(c);
      bodies[body++].setQToFitTransform(state, ~(places[c.inner] * F) * (places[c.outer] * M));
    }
    system.realize(state, SimTK::Stage::Position);
    body = 1;
    for (const Connection& c : mechanism.connections) {
      if (c.closes_loop) continue;
      const Link& inner = mechanism.links[c.inner];
      const Link& outer = mechanism.links[c.outer];
      const auto at = [&](const Link& link) -> Eigen::Vector3d {
        return link.velocity_m_s +
               link.angular_velocity_rad_s.cross(c.outer_point_m - link.position_m);
      };
      const Rotation to_F = ~(places[c.inner] * frames(c)[0]).R();
      bodies[body++].setUToFitVelocity(
          state, {to_F * vec(outer.angular_velocity_rad_s - inner.angular_velocity_rad_s),
                  to_F * vec(at(outer) - at(inner))});
    }
    return state;
  }

  const Mechanism& mechanism;
  SimTK::MultibodySystem system;
  SimTK::SimbodyMatterSubsystem matter{system};
  SimTK::GeneralForceSubsystem forces{system};
  SimTK::Force::Gravity gravity{forces, matter, vec(mechanism.gravity_m_s2)};
  std::vector<MobilizedBody> bodies;
  std::vector<Transform> places;
};

}  // namespace

std::optional<Motion> simbody_motion(const Mechanism& mechanism) {
  // Simbody's bushings use Euler angles.
  for (const Strut& strut : mechanism.struts)
    if (strut.turning_stiffness > 0) return std::nullopt;
  for (const Connection& c : mechanism.connections)
    if (c.closes_loop && c.kind == "screw") return std::nullopt;
  Twin twin(mechanism);
  const SimTK::State start = twin.start();
  SimTK::RungeKuttaMersonIntegrator integrator(twin.system);
  integrator.setAccuracy(1e-10);
  integrator.setConstraintTolerance(1e-9);
  integrator.setFinalTime(mechanism.end_s);
  SimTK::TimeStepper stepper(twin.system, integrator);
  stepper.initialize(start);
  const auto count = static_cast<Eigen::Index>(mechanism.links.size()) - 1;
  Motion motion;
  for (std::size_t k = 0; k < motion.size(); ++k)
    motion[k].resize((k == 1 ? 9 : 3) * count, mechanism.outputs + 1);
  for (int output = 0; output <= mechanism.outputs; ++output) {
    stepper.stepTo(mechanism.end_s * output / mechanism.outputs);
    const SimTK::State& state = integrator.getState();
    for (Eigen::Index k = 0; k < count; ++k) {
      const MobilizedBody& body = twin.bodies[static_cast<std::size_t>(k) + 1];
      const Transform& place = body.getBodyTransform(state);
      for (int a = 0; a < 3; ++a) {
        motion[0](3 * k + a, output) = place.p()[a];
        motion[2](3 * k + a, output) = body.getBodyOriginVelocity(state)[a];
        motion[3](3 * k + a, output) = body.getBodyAngularVelocity(state)[a];
        for (int b = 0; b < 3; ++b) motion[1](9 * k + 3 * b + a, output) = place.R()[a][b];
      }
    }
  }
  return motion;
}

}  // namespace flexneck::campaigns
