// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/tree_models.h"

#include "multibody/joints/joint_kinds.h"

namespace flexneck::testing {

multibody::RigidBody random_rigid_body(RandomNumbers& random) {
  multibody::RigidBody body;
  body.mass_kg = 2 + random.next();
  body.center_m = 0.1 * random.vector();
  const Eigen::Matrix3d turn = random.rotation().toRotationMatrix();
  body.inertia_kg_m2 = turn * Eigen::Vector3d(0.02, 0.03, 0.04).asDiagonal() * turn.transpose();
  body.inertia_kg_m2 = (body.inertia_kg_m2 + body.inertia_kg_m2.transpose()).eval() / 2;
  return body;
}

void add_forces(ModelBuilder& build, RandomNumbers& random) {
  using multibody::LoadCurve;
  multibody::Model& model = build.model;
  multibody::Resistance resistance;
  resistance.positive.curve = LoadCurve::cubic(20, 5, 30);
  resistance.positive.stop = 0.3;
  resistance.positive.beyond_stop = LoadCurve::cubic(0, 200, 50);
  resistance.positive.unloading_ratio = 0.4;
  resistance.negative.curve = LoadCurve::table({0, 0.2, 0.5}, {0, 10, 12});
  resistance.negative.unloading_ratio = 0.8;
  resistance.damping = 0.7;
  resistance.friction = 1.5;
  resistance.full_rate = 3;  // random rates are below it: no kink is near
  multibody::Resistance rope;
  rope.positive.curve = LoadCurve::cubic(40);
  rope.damping = 2;
  rope.tension_only = true;
  model.forces.add(multibody::Torque{"twist", model.marker_index("c e"),
                                     random.vector().normalized(), constant_table(4)});
  model.forces.of<multibody::MarkerSpring>() = {
      {"spring", model.marker_index("d end"), model.marker_index("k g"), 0.4, resistance},
      {"rope", model.marker_index("sled a"), model.marker_index("g h"), 0.1, rope}};
  Eigen::Matrix<double, 6, 6> root;
  random.fill(root);
  model.forces.add(multibody::Bushing{"bushing", model.marker_index("a b"),
                                      model.marker_index("h g"), 10 * root * root.transpose(),
                                      root.transpose() * root});
  using multibody::JointCoordinate;
  model.forces.of<multibody::JointResistance>() = {
      {"hinge", 0, JointCoordinate::angle, resistance},
      {"flexion", 1, JointCoordinate::flexion, resistance},
      {"slide", 3, JointCoordinate::distance, resistance},
      {"turn", 3, JointCoordinate::angle, resistance},
      {"rail", 4, JointCoordinate::distance, resistance}};
}

multibody::Model forest(bool stiffens) {
  RandomNumbers random(51);
  ModelBuilder build;
  build.model.gravity_m_s2 = {1, -2, -9.81};
  multibody::PrescribedBody sled;
  sled.direction = random.vector().normalized();
  sled.initial_velocity_m_s = 3;
  sled.acceleration_m_s2 = constant_table(7);
  sled.turn.axis = Eigen::Vector3d(2, -1, 2) / 3;
  sled.turn.point_m = {0.3, -0.2, 0.1};
  sled.turn.initial_rate_rad_s = 1.5;
  sled.turn.acceleration_rad_s2 = constant_table(4);
  const auto prescribed = build.body("sled", sled, {random.vector(), random.rotation()});
  const auto rigid = [&](const char* name) { return build.body(name, random_rigid_body(random)); };
  const auto soft = [&](const char* name, unsigned seed, int modes) {
    multibody::DeformableBody body = deformable(make_point_mass_body(seed, modes).body, 0.2);
    body.stress_stiffening = stiffens;
    return build.body(name, body);
  };
  const auto on = [&](const std::string& name, std::size_t body) {
    return build.marker(name, body, 0.2 * random.vector(), random.rotation());
  };
  const auto at = [&](const std::string& name, std::size_t body, const char* interface) {
    build.model.markers.push_back(
        {name, body, interface, Eigen::Vector3d::Zero(), random.rotation()});
    return build.model.markers.size() - 1;
  };
  const auto join = [&](const multibody::JointKind* kind, std::size_t i, std::size_t j) {
    // A universal joint whose axes are not perpendicular where the markers' axes agree.
    build.model.joints.push_back({"joint " + std::to_string(build.model.joints.size()), kind, i, j,
                                  random.vector().normalized(), random.vector().normalized()});
  };
  const auto a = rigid("a");
  const auto b = soft("b", 61, 3);
  const auto c = soft("c", 62, 2);
  const auto d = rigid("d");
  const auto e = soft("e", 63, 4);
  const auto f = rigid("f");
  const auto g = soft("g", 64, 2);
  const auto h = rigid("h");
  const auto k = rigid("k");
  join(&multibody::kRevoluteJoint, on("sled a", prescribed), on("a sled", a));
  join(&multibody::kSphericalJoint, on("a b", a), at("b a", b, "side"));
  join(&multibody::kUniversalJoint, at("c b", c, "tip"), at("b c", b, "tip"));
  join(&multibody::kCylindricalJoint, at("b d", b, "root"), on("d b", d));
  join(&multibody::kPrismaticJoint, at("e c", e, "side"), at("c e", c, "side"));
  join(&multibody::kFixedJoint, at("e f", e, "tip"), on("f e", f));
  join(&multibody::kCylindricalJoint, on("h g", h), at("g h", g, "tip"));
  join(&multibody::kUniversalJoint, at("g k", g, "side"), on("k g", k));
  join(&multibody::kFreeJoint, on("k a", k), on("a k", a));
  join(&multibody::kPrismaticJoint, on("k m", k), on("m k", rigid("m")));
  build.force("push", build.model.marker_index("b c"), random.vector(), constant_table(30));
  build.force("pull", build.marker("d end", d, {0.1, 0.2, 0.3}), random.vector(),
              constant_table(-20));
  build.interface_marker("idle", g, "tip");
  add_forces(build, random);
  return build.model;
}

multibody::Model chain_of_all_joints() {
  RandomNumbers random(55);
  ModelBuilder build;
  build.model.gravity_m_s2 = {1, -2, -9.81};
  multibody::PrescribedBody sled;
  sled.initial_velocity_m_s = 3;
  sled.turn.initial_rate_rad_s = 1.5;
  auto carrier = build.body("sled", sled, {random.vector(), random.rotation()});
  for (const multibody::JointKind* const kind : multibody::kJointKinds) {
    if (kind->motion == nullptr) continue;
    for (const bool reversed : {false, true}) {
      const std::string name = std::string(kind->name) + (reversed ? " reversed" : "");
      const auto body = build.body(name, random_rigid_body(random));
      const auto inner =
          build.marker("inner " + name, carrier, 0.2 * random.vector(), random.rotation());
      const auto outer =
          build.marker("outer " + name, body, 0.2 * random.vector(), random.rotation());
      build.model.joints.push_back({name, kind, reversed ? outer : inner, reversed ? inner : outer,
                                    random.vector().normalized(), random.vector().normalized(),
                                    0.2});
      carrier = body;
    }
  }
  return build.model;
}

}  // namespace flexneck::testing
