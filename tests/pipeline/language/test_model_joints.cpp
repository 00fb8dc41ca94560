// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>
#include <fmt/core.h>

#include "geometry/foundation/error.h"
#include "geometry/foundation/temporary_folder.h"
#include "multibody/joints/joint_kinds.h"
#include "multibody/simulation/simulation.h"
#include "pipeline/language/model/model_file.h"
#include "tests/support/model_reading.h"
#include "tests/support/model_text.h"

using Catch::Matchers::Contains;
using namespace flexneck;
using namespace flexneck::pipeline;
using testing::double_pendulum_text;
using testing::read_model;
using testing::run;
using testing::with;

namespace {

const std::string kElbow =
    "kind = \"pin\"\nlower = \"upper.end\"\nupper = \"lower.top\"\naxis = [1, 0, 0]\n"
    "angle = \"-70 deg\"\nrate = \"8 rad/s\"\n";

/// Text of the double pendulum with another joint at its elbow.
std::string with_elbow(const std::string& keys, const std::string& more = "") {
  return with(double_pendulum_text(), kElbow,
              "lower = \"upper.end\"\nupper = \"lower.top\"\n" + keys) +
         more;
}

/// Angle and advance of the lower body about and along the elbow's axis, at an output.
struct Elbow {
  double angle_rad, advance_m;
};
Elbow elbow_at(const multibody::History& history, Eigen::Index k) {
  const multibody::MarkerHistory& i = history.marker("upper.end");
  const multibody::MarkerHistory& j = history.marker("lower.top");
  const auto rotation = [&](const multibody::MarkerHistory& marker) {
    const Eigen::Vector4d q = marker.rotation.col(k);
    return Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix();
  };
  const Eigen::Matrix3d R = rotation(i).transpose() * rotation(j);
  const Eigen::Vector3d d = rotation(i).transpose() * (j.position_m.col(k) - i.position_m.col(k));
  return {std::atan2(R(2, 1), R(1, 1)), d.x()};
}

}  // namespace

TEST_CASE("a joint has the field's name or the paper's, and every kind is told in a refusal") {
  const TemporaryFolder folder;
  const auto kind_of = [&](const std::string& name) {
    return read_model(folder,
                      with(double_pendulum_text(), "kind = \"pin\"", "kind = \"" + name + "\""))
        .model.joints[0]
        .kind;
  };
  CHECK(kind_of("pin") == &multibody::kRevoluteJoint);
  CHECK(kind_of("revolute") == &multibody::kRevoluteJoint);
  const std::string bare = "axis = [1, 0, 0]\n";
  CHECK(read_model(folder, with_elbow("kind = \"prismatic\"\n" + bare)).model.joints[1].kind ==
        &multibody::kPrismaticJoint);
  CHECK(read_model(folder, with_elbow("kind = \"ball\"\n")).model.joints[1].kind ==
        &multibody::kSphericalJoint);
  CHECK_THROWS_WITH(kind_of(""), Contains("\"revolute\"") && Contains("\"screw\"") &&
                                     Contains("\"distance\"") && Contains("found \"\""));
}

TEST_CASE("a screw starts on its thread and stays on it") {
  const TemporaryFolder folder;
  const std::string screw = "kind = \"screw\"\naxis = [1, 0, 0]\nlead = \"40 mm\"\n";
  const ModelFile file =
      read_model(folder, with_elbow(screw + "angle = \"-70 deg\"\nrate = \"8 rad/s\"\n"));
  const multibody::History history = run(file);
  for (const Eigen::Index k : {0, 100, 200}) {
    const Elbow elbow = elbow_at(history, k);
    const double off = elbow.advance_m / 0.04 - elbow.angle_rad / (2 * std::numbers::pi);
    CHECK(std::abs(off - std::round(off)) < 1e-9);
  }
  CHECK(elbow_at(history, 0).angle_rad == Approx(-70 * std::numbers::pi / 180));
  CHECK_THROWS_WITH(read_model(folder, with_elbow("kind = \"screw\"\naxis = [1, 0, 0]\n")),
                    Contains("lead"));
  CHECK_THROWS_WITH(read_model(folder, with_elbow(with(screw, "40", "0"))),
                    Contains("lead must be other than zero"));
  CHECK_THROWS_WITH(read_model(folder, with_elbow(screw + "distance = \"1 mm\"\n")),
                    Contains("distance"));
}

TEST_CASE("a motor makes a joint follow an expression or a table from where the joint starts") {
  const TemporaryFolder folder;
  const std::string pin = "kind = \"pin\"\naxis = [1, 0, 0]\nangle = \"-70 deg\"\n";
  const std::string motor =
      "\n[[motor]]\nname = \"drive\"\njoint = \"elbow\"\ncoordinate = \"angle\"\n";
  const std::string expression =
      GENERATE("angle = \"2*sin(9*t)\"\n",
               "times = [\"0 s\", \"0.1 s\", \"0.2 s\", \"0.3 s\"]\n"
               "angle = [\"0 rad\", \"0.5 rad\", \"1.4 rad\", \"2.7 rad\"]\n");
  const bool is_table = expression.starts_with("times");
  const multibody::History history = run(read_model(folder, with_elbow(pin, motor + expression)));
  const double start = -70 * std::numbers::pi / 180;
  // The rows of the table are on a parabola, which its spline reproduces.
  const auto path = [&](double t) { return is_table ? 3 * t + 20 * t * t : 2 * std::sin(9 * t); };
  for (const Eigen::Index k : {0, 50, 100, 200})
    CHECK(elbow_at(history, k).angle_rad == Approx(start + path(history.time_s[k])).margin(1e-9));
}

TEST_CASE("a motor that says nothing, or what its joint says too, is refused") {
  const TemporaryFolder folder;
  const std::string pin = "kind = \"pin\"\naxis = [1, 0, 0]\nangle = \"-70 deg\"\n";
  const std::string motor = "\n[[motor]]\nname = \"drive\"\njoint = \"elbow\"\n";
  const auto refused = [&](const std::string& joint, const std::string& keys,
                           const std::string& reason) {
    CHECK_THROWS_WITH(run(read_model(folder, with_elbow(joint, motor + keys))), Contains(reason));
  };
  refused(pin, "coordinate = \"angle\"\n", "expected the motion of the motor");
  refused(pin, "coordinate = \"twist\"\nangle = \"t\"\n", "expected one of");
  refused(pin, "coordinate = \"distance\"\ndistance = \"t\"\n", "cannot prescribe its distance");
  refused(pin + "rate = \"1 rad/s\"\n", "coordinate = \"angle\"\nangle = \"t\"\n",
          "given by the joint and by this motor");
  refused(pin, "coordinate = \"angle\"\nangle = \"t\"\nacceleration = \"t\"\n", "already given by");
}

TEST_CASE("a distance joint closes a loop between bodies that others put in their place") {
  const TemporaryFolder folder;
  const std::string rod =
      "\n[[joint]]\nname = \"rod\"\nkind = \"distance\"\nlower = \"ground.hook\"\n"
      "upper = \"lower.tip\"\nlength = ";
  const ModelFile file = read_model(folder, double_pendulum_text() + rod + "\"1 m\"\n");
  const Eigen::Vector3d tip =
      file.model.bodies[2].initial_pose.position_m +
      file.model.bodies[2].initial_pose.rotation * Eigen::Vector3d(0, 0.03, -0.2);
  const double length = (tip - Eigen::Vector3d(0, 0, 1)).norm();
  CHECK_THROWS_WITH(run(file), Contains("joint 'rod'") && Contains("apart"));
  // The rod has a length that fits, and velocities that would not fit are left out.
  std::string text = with(double_pendulum_text(), "rate = \"300 deg/s\"\n", "");
  text = with(text, "rate = \"8 rad/s\"\n", "") + rod + "\"" + fmt::format("{:.12f}", length) +
         " m\"\n";
  const multibody::History history = run(read_model(folder, text));
  const multibody::MarkerHistory& end = history.marker("lower.tip");
  const Eigen::Index last = history.time_s.size() - 1;
  CHECK((end.position_m.col(last) - end.position_m.col(0)).norm() > 0.01);
  CHECK((end.position_m.col(last) - Eigen::Vector3d(0, 0, 1)).norm() ==
        Approx(length).epsilon(1e-8));
}
