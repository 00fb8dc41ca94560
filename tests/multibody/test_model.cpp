// SPDX-License-Identifier: GPL-3.0-or-later
#include <functional>
#include <limits>

#include <catch2/catch.hpp>

#include "geometry/foundation/error.h"
#include "multibody/joints/joint_kinds.h"
#include "multibody/model/model.h"
#include "tests/support/test_models.h"

using namespace flexneck;
using namespace flexneck::multibody;
using Catch::Contains;

namespace {

Model sound_model() {
  auto build = testing::head_on_neck({}, {}, {}, 0.1, testing::make_head());
  build.force("push", build.model.marker_index("head cg"), {1, 0, 0}, testing::constant_table(1));
  build.body("loose", testing::make_head());
  return build.model;
}

RigidBody& head_of(Model& model) { return std::get<RigidBody>(model.bodies[2].kind); }
DeformableBody& neck_of(Model& model) { return std::get<DeformableBody>(model.bodies[1].kind); }

/// Message of check() for a sound model with one change.
std::string complaint(const std::function<void(Model&)>& spoil) {
  Model model = sound_model();
  spoil(model);
  try {
    check(model);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no complaint";
}

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

}  // namespace

TEST_CASE("A sound model passes, with a body that nothing holds") {
  CHECK_NOTHROW(check(sound_model()));
}

TEST_CASE("Look-ups by name find or name the nearest") {
  const Model model = sound_model();
  CHECK(model.body_index("head") == 2);
  CHECK(model.marker_index("neck top") == 2);
  CHECK(model.joint_index("OC") == 1);
  CHECK_THROWS_WITH(model.body_index("haed"), Contains("did you mean 'head'"));
  CHECK_THROWS_WITH(model.marker_index("x"), Contains("'neck base'"));
  CHECK_THROWS_WITH(model.joint_index("OCC"), Contains("'OC'"));
}

TEST_CASE("Names that are empty, doubled or hold a slash are refused") {
  CHECK_THAT(complaint([](Model& m) { m.bodies[2].name = ""; }), Contains("body 3 has no name"));
  CHECK_THAT(complaint([](Model& m) { m.markers[1].name = "base"; }),
             Contains("marker 'base' occurs twice"));
  CHECK_THAT(complaint([](Model& m) { m.joints[0].name = "a/b"; }), Contains("joint 'a/b'"));
}

TEST_CASE("Masses and inertias that no body has are refused") {
  CHECK_THAT(complaint([](Model& m) { head_of(m).mass_kg = 0; }),
             Contains("body 'head': mass must be positive"));
  CHECK_THAT(complaint([](Model& m) { head_of(m).mass_kg = kNan; }), Contains("body 'head': mass"));
  CHECK_THAT(complaint([](Model& m) { head_of(m).center_m[1] = kNan; }),
             Contains("body 'head': centre of mass is not finite"));
  CHECK_THAT(complaint([](Model& m) { head_of(m).inertia_kg_m2(0, 1) = 1e-3; }),
             Contains("symmetric"));
  CHECK(complaint([](Model& m) { head_of(m).inertia_kg_m2.setZero(); }) == "no complaint");
  CHECK_THAT(complaint([](Model& m) {
               head_of(m).inertia_kg_m2 = Eigen::Vector3d(1, 1, -1).asDiagonal();
             }),
             Contains("principal moment of inertia may be negative"));
}

TEST_CASE("The triangle inequality of inertias holds to 1e-9, and a flat body is allowed") {
  const auto principal = [](double largest) {
    return complaint([&](Model& m) {
      const Eigen::Matrix3d turn = Eigen::Quaterniond(0.3, -0.5, 0.7, 0.4).normalized().matrix();
      head_of(m).inertia_kg_m2 =
          turn * Eigen::Vector3d(1, 2, largest).asDiagonal() * turn.transpose();
      head_of(m).inertia_kg_m2 =
          (head_of(m).inertia_kg_m2 + head_of(m).inertia_kg_m2.transpose()).eval() / 2;
    });
  };
  CHECK(principal(3.0) == "no complaint");
  CHECK(principal(3.0 * (1 + 5e-10)) == "no complaint");
  CHECK_THAT(principal(3.0 * (1 + 2e-9)), Contains("exceeds the sum of the others"));
}

TEST_CASE("Deformable bodies with odd damping, frequencies or invariants are refused") {
  CHECK_THAT(complaint([](Model& m) { neck_of(m).damping_ratio[2] = -0.1; }),
             Contains("body 'neck'") && Contains("must not be negative"));
  CHECK_THAT(complaint([](Model& m) { neck_of(m).damping_ratio[0] = kNan; }),
             Contains("damping ratio of mode"));
  CHECK_THAT(complaint([](Model& m) { neck_of(m).damping_ratio.conservativeResize(3); }),
             Contains("one damping ratio per mode, 4, but there are 3"));
  CHECK_THAT(complaint([](Model& m) { neck_of(m).modes.frequencies_Hz[0] = 0; }),
             Contains("frequencies must be positive"));
  CHECK_THAT(complaint([](Model& m) {
               neck_of(m).modes.slits.push_back({"cut opens 1", true, Eigen::RowVector4d::Ones()});
             }),
             Contains("body 'neck'") && Contains("would open and close without contact"));
  CHECK_THAT(complaint([](Model& m) { neck_of(m).modes.invariants.Maa *= 4; }),
             Contains("not mass-normalised"));
  CHECK_THAT(complaint([](Model& m) { neck_of(m).modes.invariants.S2 *= 10; }),
             Contains("not positive definite"));
  CHECK_THAT(complaint([](Model& m) { neck_of(m).modes.invariants.G0.pop_back(); }),
             Contains("invariants do not have the sizes for 4 modes"));
  CHECK_THAT(complaint([](Model& m) { neck_of(m).modes.interfaces[1].rotation.resize(3, 2); }),
             Contains("interface 'top'"));
}

TEST_CASE("Vectors that should be of unit length and prescribed bodies' motions are checked") {
  CHECK_THAT(complaint([](Model& m) { m.bodies[1].initial_pose.rotation.w() = 1.1; }),
             Contains("body 'neck': rotation must be a unit quaternion"));
  CHECK_THAT(complaint([](Model& m) {
               std::get<PrescribedBody>(m.bodies[0].kind).direction = {1, 1, 0};
             }),
             Contains("body 'base': direction of motion must be a unit vector"));
  CHECK_THAT(complaint([](Model& m) {
               m.bodies[0].initial_velocity_m_s = {1, 0, 0};
             }),
             Contains("body 'base': its motion is prescribed"));
  CHECK_THAT(complaint([](Model& m) { m.forces.of<PointForce>()[0].direction.setZero(); }),
             Contains("force 'push': direction"));
  CHECK_THAT(complaint([](Model& m) {
               m.joints[0].kind = &kRevoluteJoint;
               m.joints[0].axis *= 2;
             }),
             Contains("joint 'neck base': axis"));
  CHECK_THAT(complaint([](Model& m) { m.gravity_m_s2[0] = kNan; }), Contains("gravity"));
}

TEST_CASE("Markers and joints must fit their bodies") {
  CHECK_THAT(complaint([](Model& m) { m.markers[2].interface = "topp"; }),
             Contains("marker 'neck top'") && Contains("did you mean 'top'"));
  CHECK_THAT(complaint([](Model& m) { m.markers[2].interface = ""; }),
             Contains("marker 'neck top'") && Contains("'base' 'top'"));
  CHECK_THAT(complaint([](Model& m) { m.markers[3].interface = "top"; }),
             Contains("body 'head' is not deformable"));
  CHECK_THAT(complaint([](Model& m) { m.markers[3].body = 9; }), Contains("no body of index 9"));
  CHECK_THAT(complaint([](Model& m) { m.joints[1].marker_j = 9; }),
             Contains("joint 'OC': there is no marker of index 9"));
  CHECK_THAT(complaint([](Model& m) { m.joints[1].marker_j = 1; }),
             Contains("both markers are on body 'neck'"));
  CHECK_THAT(complaint([](Model& m) {
               m.bodies[2].kind = PrescribedBody{};
               m.joints[1].marker_i = 0;
             }),
             Contains("'base' and 'head', whose motions are both prescribed"));
}
