// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "geometry/foundation/error.h"
#include "geometry/foundation/temporary_folder.h"
#include "pipeline/language/model/csv_table.h"
#include "pipeline/language/model/expression.h"
#include "pipeline/language/model/model_file.h"
#include "tests/support/model_reading.h"
#include "tests/support/model_text.h"

using Catch::Matchers::Contains;
using namespace flexneck;
using namespace flexneck::pipeline;
using testing::box_text;
using testing::double_pendulum_text;
using testing::fixed_joint_text;
using testing::origin_marker_text;
using testing::read_model;
using testing::refusal_of_model;
using testing::run;
using testing::with;
using testing::write_test_file;

TEST_CASE("a prescribed body follows a table, a pulse or an expression, and one of them only") {
  const TemporaryFolder folder;
  const auto sled = [&](const std::string& motion) {
    return with(double_pendulum_text(), "kind = \"ground\"", "kind = \"prescribed\"\n" + motion);
  };
  const auto prescribed = [&](const std::string& motion) {
    return std::get<multibody::PrescribedBody>(
        read_model(folder, sled(motion)).model.bodies[0].kind);
  };
  CHECK(prescribed("displacement = \"0.05 * sin(2*pi*3*t)\"").motion.velocity_m_s(0) ==
        Approx(0.05 * 6 * std::numbers::pi));
  CHECK(prescribed("acceleration = \"-20 * gn * (t < 0.1)\"").motion.velocity_m_s(0.2) ==
        Approx(-20 * 9.80665 * 0.1));
  CHECK(prescribed("times = [\"0 ms\", \"10 ms\"]\nacceleration = [\"0 gn\", \"2 gn\"]")
            .acceleration_m_s2.integral(1) == Approx(0.01 * 9.80665));
  const auto pulse = prescribed(
      "initial_velocity = \"3 m/s\"\npulse_times = [\"0 s\", \"1 s\"]\n"
      "pulse_deceleration = [\"5 gn\", \"0 gn\"]");
  CHECK(pulse.acceleration_m_s2.integral(1) == Approx(-3).epsilon(1e-15));
  // The other bodies start with the prescribed body's velocity.
  CHECK(read_model(folder, sled("initial_velocity = \"3 m/s\""))
            .model.bodies[1]
            .initial_velocity_m_s.x() == Approx(3));

  CHECK_THAT(refusal_of_model(folder, sled("displacement = \"t\"\nacceleration = \"t\"")),
             Contains("body.ground.displacement: the motion is already given by 'acceleration'"));
  CHECK_THAT(refusal_of_model(folder, sled("displacement = \"sin(t\"")),
             Contains("body.ground.displacement: \"sin(t\" is not a valid expression"));
  CHECK_THAT(refusal_of_model(folder, sled("displacement = \"sqrt(t - 1)\"")),
             Contains("is not a finite number"));
  CHECK_THAT(refusal_of_model(folder, sled("displacement = \"abs(t - 0.1)\"")),
             Contains("must be smooth"));
  CHECK_THAT(refusal_of_model(folder, sled("")),
             Contains("expected the motion of a prescribed body"));
}

TEST_CASE("a sled pulse over a minute, a turn and a motor gain what their expressions make") {
  const TemporaryFolder folder;
  const std::string blocks = R"toml([[body]]
name = "block"
kind = "rigid"
mass = "1 kg"
center = ["0 m", "0 m", "0 m"]
inertia = ["1 kg*m^2", "1 kg*m^2", "1 kg*m^2"]
[[marker]]
body = "sled"
name = "o"
position = ["0 m", "0 m", "0 m"]
[[marker]]
body = "block"
name = "o"
position = ["0 m", "0 m", "0 m"]
[[joint]]
name = "j"
lower = "sled.o"
upper = "block.o"
)toml";
  const std::string axis = "axis = [0, 0, 1]\n";
  const std::string pulse =
      "acceleration = \"-100 * sin(pi*(t-27.6)/0.08) * (t>27.6 && t<27.68)\"\n";
  const auto at_end = [&](const std::string& sled, const std::string& more) {
    return run(read_model(folder,
                          "[solver]\nend_time = \"60 s\"\n[output]\ninterval = \"60 s\"\n"
                          "[[body]]\nname = \"sled\"\n" +
                              sled + blocks + more));
  };
  const double gained = -200 * 0.08 / std::numbers::pi;
  const std::string prescribed = "kind = \"prescribed\"\n";
  // The pulse of the README, over one minute.
  CHECK(at_end(prescribed + "acceleration = \"-100 * sin(pi * t / 0.08) * (t < 0.08)\"\n",
               "kind = \"fixed\"\n")
            .marker("block.o")
            .velocity_m_s(0, 1) == Approx(gained).epsilon(1e-9));
  CHECK(at_end(prescribed + "[body.turn]\naxis = [0, 0, 1]\n" + pulse, "kind = \"fixed\"\n")
            .marker("block.o")
            .angular_velocity_rad_s(2, 1) == Approx(gained).epsilon(1e-9));
  const std::string ground = "kind = \"ground\"\n";
  const std::string motor = "[[motor]]\nname = \"m\"\njoint = \"j\"\n";
  CHECK(at_end(ground,
               axis + "kind = \"prismatic\"\n" + motor + "coordinate = \"distance\"\n" + pulse)
            .marker("block.o")
            .velocity_m_s(2, 1) == Approx(gained).epsilon(1e-6));
  // A bell curve has no kink at which steps would end: the block slides on its sled and stays.
  for (const std::string integrator : {"dormand_prince", "generalised_alpha"}) {
    const auto history =
        run(read_model(folder, "[solver]\nend_time = \"3 s\"\nintegrator = \"" + integrator +
                                   "\"\n[output]\ninterval = \"3 s\"\n[[body]]\nname = \"sled\"\n" +
                                   prescribed + "direction = [0, 0, 1]\n" +
                                   "acceleration = \"1000 * exp(-((t - 1.5) / 0.002)^2)\"\n" +
                                   blocks + axis + "kind = \"prismatic\"\n"));
    CHECK(history.marker("sled.o").velocity_m_s(2, 1) ==
          Approx(2 * std::sqrt(std::numbers::pi)).epsilon(1e-9));
    CHECK(history.marker("block.o").velocity_m_s(2, 1) == Approx(0).margin(0.02));
  }
}

TEST_CASE("the resolution of expressions is a key, and breakpoints go with expressions") {
  const TemporaryFolder folder;
  const auto sled = [&](const std::string& motion, const std::string& key = "") {
    return with(
        with(double_pendulum_text(), "kind = \"ground\"", "kind = \"prescribed\"\n" + motion),
        "[solver]\n", "[solver]\n" + key);
  };
  const auto gained = [&](const std::string& text) {
    return std::get<multibody::PrescribedBody>(read_model(folder, text).model.bodies[0].kind)
        .motion.velocity_m_s(0.2);
  };
  const std::string blow = "acceleration = \"1e6 * (t > 0.1 && t < 0.100001)\"\n";
  CHECK(gained(sled(blow, "resolution = \"1 us\"\n")) == Approx(1).epsilon(1e-6));
  CHECK(gained(sled(blow + "breakpoints = [\"0.1 s\", \"0.100001 s\"]\n")) ==
        Approx(1).epsilon(1e-6));
  CHECK_THAT(
      refusal_of_model(folder, sled("initial_velocity = \"1 m/s\"\nbreakpoints = [\"1 ms\"]\n")),
      Contains("body.ground.breakpoints: has no effect without a motion"));
  const auto has_resolution = [&](const std::string& text) {
    const auto parameters = read_model(folder, text).parameters;
    return std::ranges::any_of(
        parameters, [](const Parameter& each) { return each.key == "solver.resolution"; });
  };
  CHECK(has_resolution(sled(blow)));
  CHECK_FALSE(has_resolution(double_pendulum_text()));
}

TEST_CASE("an expression is one value: no sequence, no assignment, no chain of comparisons") {
  const Expression sine("0.05 * sin(2 * pi * 3 * t) + max(t, 0.5 * t, (1))");
  CHECK(sine(0.1) == Approx(0.05 * std::sin(0.6 * std::numbers::pi) + 1).epsilon(1e-15));
  CHECK(Expression("(0 < t) && (t <= 1) ? t == 0.5 ? 7 : 2 : t != 3")(0.5) == 7);
  CHECK(Expression("-t^2")(3) == -9);
  CHECK(Expression("a / b - a", {"a", "b"})(std::array{6.0, 3.0}) == -4);
  CHECK_THROWS_WITH(Expression("t", {"a"}), Contains("is not a valid expression"));
  // muParser alone accepts all of them: 81, 5 t, 4, 0, t, 2, and 1 for any time.
  for (const char* const text : {"9,81", "0,5*t", "1 ? 2 : 3, 4", "t = 0", "(t = 1) + t",
                                 "max(t = 1, 2)", "0 < t < 0.1", "t == 1 == 1"}) {
    INFO(text);
    CHECK_THROWS_WITH(Expression(text), Contains("is not a valid expression: at character"));
  }
  CHECK_THROWS_WITH(Expression("9,81"), Contains("use a point for decimals"));
  for (const char* const text : {"", "2 t", "sin(9,81)", "(9,81)", "\"t\"", "t;1", "inf", "0x10"}) {
    INFO(text);
    CHECK_THROWS_WITH(Expression(text), Contains("is not a valid expression"));
  }
  CHECK_THROWS_AS(Expression(std::string(100000, '(') + "t"), InputError);
}

TEST_CASE("a prescribed body turns by the same kinds of motion, and its body starts with it") {
  const TemporaryFolder folder;
  const auto turntable = [&](const std::string& motion) {
    return with(double_pendulum_text(), "kind = \"ground\"",
                "kind = \"prescribed\"\n[body.turn]\naxis = [0, 0, 1]\n" + motion);
  };
  const auto turn = [&](const std::string& motion) {
    return std::get<multibody::PrescribedBody>(
               read_model(folder, turntable(motion)).model.bodies[0].kind)
        .turn;
  };
  CHECK(turn("angle = \"0.2 * sin(10 * t)\"").motion.velocity_m_s(0) == Approx(2));
  CHECK(turn("initial_rate = \"90 deg/s\"").initial_rate_rad_s == Approx(std::numbers::pi / 2));
  CHECK(turn("point = [\"1 m\", \"0 m\", \"0 m\"]\ntimes = [\"0 s\", \"1 s\"]\n"
             "acceleration = [\"0 deg/s^2\", \"180 deg/s^2\"]")
            .acceleration_rad_s2.integral(1) == Approx(std::numbers::pi / 2));
  CHECK(turn("initial_rate = \"3 rad/s\"\npulse_times = [\"0 s\", \"1 s\"]\n"
             "pulse_deceleration = [\"5 rad/s^2\", \"0 rad/s^2\"]")
            .acceleration_rad_s2.integral(1) == Approx(-3));
  write_test_file(folder / "angle.csv",
                  "time [ms], angle [deg]\n0, 30\n100, 35\n200, 37\n300, 30\n");
  const auto tabulated = turn("angle_table = \"angle.csv\"");
  CHECK(tabulated.motion.displacement_m(0.1) == Approx(35 * std::numbers::pi / 180));
  // Bodies connected to it are rotated with it by the 30 degrees of the first row.
  const auto upper = read_model(folder, turntable("angle_table = \"angle.csv\""))
                         .model.bodies[1]
                         .initial_pose.rotation;
  CHECK(upper.z() / upper.w() == Approx(std::tan(std::numbers::pi / 12)).epsilon(1e-12));

  CHECK_THAT(refusal_of_model(folder, turntable("")),
             Contains("expected the motion of the rotation"));
  CHECK_THAT(refusal_of_model(folder, turntable("angle = \"t\"\nangle_table = \"angle.csv\"")),
             Contains("motion is already given by 'angle'"));
  CHECK_THAT(refusal_of_model(folder, turntable("initial_rate = \"3 m/s\"")),
             Contains("body.ground.turn.initial_rate"));
  write_test_file(folder / "short.csv",
                  "time [ms], angle [deg]\n0, 30\n50, 35\n100, 37\n150, 30\n");
  CHECK_THAT(refusal_of_model(folder, turntable("angle_table = \"short.csv\"")),
             Contains("must cover the run, from 0 to 0.2 s, but are from 0 to 0.15 s"));
  write_test_file(folder / "back.csv", "time [ms], angle [deg]\n0, 30\n50, 35\n40, 37\n300, 30\n");
  CHECK_THAT(refusal_of_model(folder, turntable("angle_table = \"back.csv\"")),
             Contains("back.csv:4"));
}

TEST_CASE("a body that two prescribed ones hold is prescribed twice") {
  const TemporaryFolder folder;
  const std::string sled = R"(
[[body]]
name = "sled"
kind = "prescribed"
initial_velocity = "1 m/s"
)";
  CHECK_THAT(
      refusal_of_model(folder, double_pendulum_text() + sled + origin_marker_text("sled", "seat") +
                                   box_text("box", "foot") +
                                   fixed_joint_text("one", "sled.seat", "box.foot") +
                                   fixed_joint_text("two", "ground.hook", "box.foot")),
      Contains("the motion of body 'box' is prescribed twice: joint 'one' fixes it to "
               "'sled' and joint 'two' "
               "to 'ground'"));
}

TEST_CASE("a start that is said twice must be the same both times") {
  const TemporaryFolder folder;
  const std::string upper = "name = \"upper\"\nkind = \"rigid\"\n";
  const auto told = [&](const std::string& more) {
    return refusal_of_model(folder, with(double_pendulum_text(), upper, upper + more));
  };
  const std::string place = "position = [\"0 m\", \"0 m\", \"1 m\"]\n";
  CHECK_THAT(told(place + "rotation = [\"0 deg\", \"30 deg\", \"0 deg\"]\n"),
             Contains("joint 'shoulder': angle = 0.698132 rad") && Contains("body 'upper'") &&
                 Contains("rotation = (0, 0.523599, 0) rad"));
  CHECK(told(place + "rotation = [\"0 deg\", \"40 deg\", \"0 deg\"]\n") == "nothing was refused");
  CHECK_THAT(told("angular_velocity = [\"0 rad/s\", \"1 rad/s\", \"0 rad/s\"]\n"),
             Contains("joint 'shoulder': rate = 5.23599 rad/s") && Contains("body 'upper'") &&
                 Contains("angular_velocity = (0, 1, 0) rad/s"));
  const std::string solver = "[solver]\n";
  for (const std::string rest : {"start = \"equilibrium\"", "analysis = \"quasi_static\""})
    CHECK_THAT(refusal_of_model(folder, with(double_pendulum_text(), solver, solver + rest + "\n")),
               Contains("joint 'shoulder': rate = 5.23599 rad/s") && Contains(rest));
}
