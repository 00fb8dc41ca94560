// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "geometry/foundation/error.h"
#include "geometry/foundation/hdf5_file.h"
#include "geometry/foundation/temporary_folder.h"
#include "multibody/files/history_file.h"
#include "pipeline/model/csv_table.h"
#include "pipeline/model/expression.h"
#include "pipeline/model/model_file.h"
#include "tests/support/modal_files.h"
#include "tests/support/model_text.h"

using Catch::Matchers::Contains;
using namespace flexneck;
using namespace flexneck::pipeline;
using testing::box_text;
using testing::double_pendulum_text;
using testing::fixed_joint_text;
using testing::origin_marker_text;
using testing::with;
using testing::write_text;

namespace {

ModelFile read(const TemporaryFolder& folder, const std::string& text) {
  return read_model_file(write_text(folder / "model.toml", text), {});
}

/// What reading and running this model refuses.
std::string refusal(const TemporaryFolder& folder, const std::string& text) {
  try {
    const ModelFile file = read(folder, text);
    multibody::simulate(file.model, file.solver, {file.end_time_s, file.output.interval_s});
  } catch (const InputError& error) {
    return error.what();
  }
  return "nothing was refused";
}

}  // namespace

TEST_CASE("bodies are where their joints put them and move as their joints say") {
  const TemporaryFolder folder;
  const ModelFile file = read(folder, double_pendulum_text());
  const multibody::Model& model = file.model;
  const multibody::Body& upper = model.bodies[1];
  const multibody::Body& lower = model.bodies[2];
  CHECK((upper.initial_pose.position_m - Eigen::Vector3d(0, 0, 1)).norm() < 1e-15);
  const double angle = 40 * std::numbers::pi / 180;
  const Eigen::Vector3d elbow(-0.4 * std::sin(angle), 0, 1 - 0.4 * std::cos(angle));
  CHECK((lower.initial_pose.position_m - elbow).norm() < 1e-15);
  const double rate = 300 * std::numbers::pi / 180;
  CHECK((upper.initial_angular_velocity_rad_s - Eigen::Vector3d(0, rate, 0)).norm() < 1e-14);
  // It turns about y with the upper body, and about the elbow's own axis.
  const Eigen::Vector3d turning =
      Eigen::Vector3d(0, rate, 0).cross(elbow - Eigen::Vector3d(0, 0, 1));
  CHECK((lower.initial_velocity_m_s - turning).norm() < 1e-14);
  const Eigen::Vector3d axis = Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitY()) *
                               (Eigen::AngleAxisd(std::numbers::pi / 6, Eigen::Vector3d::UnitZ()) *
                                Eigen::Vector3d::UnitX());
  const Eigen::Vector3d w = lower.initial_pose.rotation * lower.initial_angular_velocity_rad_s;
  CHECK((w - Eigen::Vector3d(0, rate, 0) - 8 * axis).norm() < 1e-14);
  // So the joints hold at the start, in position and velocity.
  CHECK(refusal(folder, double_pendulum_text()) == "nothing was refused");
  CHECK(file.parameters.size() > 30);
}

TEST_CASE("every kind of force is read in its units") {
  const TemporaryFolder folder;
  write_text(folder / "load.csv",
             "# a comment\ntime [ms], idle [1], load [lbf]\n0, 1, 2\n\n5, 1, 4\n");
  const ModelFile file = read(folder, double_pendulum_text() + R"(
[[force]]
name = "push"
marker = "lower.tip"
direction = [0, 3, 4]
table = "load.csv"
column = "load"
outside = "zero"
[[torque]]
name = "twist"
marker = "upper.top"
direction = [0, 1, 0]
magnitude = "1 lbf*ft"
[[spring]]
name = "cord"
lower = "ground.hook"
upper = "lower.tip"
free_length = "300 mm"
deflections = ["0 mm", "10 mm"]
loads = ["0 N", "5 N"]
tension_only = true
[[bushing]]
name = "mount"
lower = "ground.hook"
upper = "lower.tip"
translation_stiffness = ["1 N/mm", "2 N/mm", "3 N/mm"]
rotation_stiffness = ["1 N*m/deg", "0 N*m/deg", "0 N*m/deg", "0 N*m/deg", "1 N*m/deg", "0 N*m/deg", "0 N*m/deg", "0 N*m/deg", "1 N*m/deg"]
translation_damping = ["1 N*s/m", "1 N*s/m", "1 N*s/m"]
[[resistance]]
name = "elbow stop"
joint = "elbow"
coordinate = "angle"
stiffness = "1 N*m/deg"
damping = "0.1 N*m*s/rad"
friction = "0.2 N*m"
full_rate = "10 deg/s"
[resistance.negative]
cubic = "2 N*m/rad^3"
stop = "30 deg"
stop_stiffness = "5 N*m/rad"
unloading_ratio = 0.5
[[line_force]]
name = "piston"
lower = "ground.hook"
upper = "lower.tip"
times = ["0 ms", "10 ms"]
magnitudes = ["0 kN", "2 kN"]
outside = "zero"
)");
  const multibody::Model& model = file.model;
  const double deg = std::numbers::pi / 180;
  const double lbf = 4.4482216152605;
  CHECK(
      model.forces.of<multibody::PointForce>()[0].direction.isApprox(Eigen::Vector3d(0, 0.6, 0.8)));
  CHECK(model.forces.of<multibody::PointForce>()[0].magnitude_N.value(0.0025) == Approx(3 * lbf));
  CHECK(model.forces.of<multibody::PointForce>()[0].magnitude_N.value(0.006) == 0);
  CHECK(model.forces.of<multibody::Torque>()[0].magnitude_Nm.value(7) == Approx(12 * 0.0254 * lbf));
  CHECK(model.forces.of<multibody::MarkerSpring>()[0].resistance.positive.load(0.02) == Approx(10));
  CHECK(model.forces.of<multibody::MarkerSpring>()[0].resistance.tension_only);
  CHECK(model.forces.of<multibody::Bushing>()[0].stiffness(2, 2) == Approx(3000));
  CHECK(model.forces.of<multibody::Bushing>()[0].stiffness(4, 4) == Approx(1 / deg));
  CHECK(model.forces.of<multibody::Bushing>()[0].damping(0, 0) == Approx(1));
  const multibody::Resistance& stop = model.forces.of<multibody::JointResistance>()[0].resistance;
  CHECK(stop.positive.load(deg) == Approx(1));
  CHECK(stop.negative.load(0.6) ==
        Approx(2 * 0.6 * 0.6 * 0.6 + 5 * (0.6 - 30 * deg)).epsilon(1e-12));
  CHECK(stop.negative.unloading_ratio == 0.5);
  CHECK(stop.full_rate == Approx(10 * deg));
  const auto& piston = model.forces.of<multibody::LineForce>()[0];
  CHECK(model.markers[piston.marker_j].name == "lower.tip");
  CHECK(piston.magnitude_N.value(0.005) == Approx(1000));
  CHECK(piston.magnitude_N.value(0.02) == 0);
  CHECK(file.files.size() == 2);
}

TEST_CASE("a prescribed body follows a table, a pulse or an expression, and one of them only") {
  const TemporaryFolder folder;
  const auto sled = [&](const std::string& motion) {
    return with(double_pendulum_text(), "kind = \"ground\"", "kind = \"prescribed\"\n" + motion);
  };
  const auto prescribed = [&](const std::string& motion) {
    return std::get<multibody::PrescribedBody>(read(folder, sled(motion)).model.bodies[0].kind);
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
  // The bodies start with it.
  CHECK(
      read(folder, sled("initial_velocity = \"3 m/s\"")).model.bodies[1].initial_velocity_m_s.x() ==
      Approx(3));

  CHECK_THAT(refusal(folder, sled("displacement = \"t\"\nacceleration = \"t\"")),
             Contains("body.ground.displacement: the motion is given already by 'acceleration'"));
  CHECK_THAT(refusal(folder, sled("displacement = \"sin(t\"")),
             Contains("body.ground.displacement: \"sin(t\" cannot be read"));
  CHECK_THAT(refusal(folder, sled("displacement = \"sqrt(t - 1)\"")),
             Contains("is not a finite number"));
  CHECK_THAT(refusal(folder, sled("displacement = \"abs(t - 0.1)\"")), Contains("must be smooth"));
  CHECK_THAT(refusal(folder, sled("")), Contains("a prescribed body needs a motion"));
}

TEST_CASE("an expression is one value: no sequence, no assignment, no chain of comparisons") {
  const Expression sine("0.05 * sin(2 * pi * 3 * t) + max(t, 0.5 * t, (1))");
  CHECK(sine(0.1) == Approx(0.05 * std::sin(0.6 * std::numbers::pi) + 1).epsilon(1e-15));
  CHECK(Expression("(0 < t) && (t <= 1) ? t == 0.5 ? 7 : 2 : t != 3")(0.5) == 7);
  CHECK(Expression("-t^2")(3) == -9);
  // muParser alone takes all of them: 81, 5 t, 4, 0, t, 2, and 1 for any time.
  for (const char* const text : {"9,81", "0,5*t", "1 ? 2 : 3, 4", "t = 0", "(t = 1) + t",
                                 "max(t = 1, 2)", "0 < t < 0.1", "t == 1 == 1"}) {
    INFO(text);
    CHECK_THROWS_WITH(Expression(text), Contains("cannot be read: at character"));
  }
  CHECK_THROWS_WITH(Expression("9,81"), Contains("decimals have a point"));
  for (const char* const text : {"", "2 t", "sin(9,81)", "(9,81)", "\"t\"", "t;1", "inf", "0x10"}) {
    INFO(text);
    CHECK_THROWS_WITH(Expression(text), Contains("cannot be read"));
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
    return std::get<multibody::PrescribedBody>(read(folder, turntable(motion)).model.bodies[0].kind)
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
  write_text(folder / "angle.csv", "time [ms], angle [deg]\n0, 30\n100, 35\n200, 37\n300, 30\n");
  const auto tabulated = turn("angle_table = \"angle.csv\"");
  CHECK(tabulated.motion.displacement_m(0.1) == Approx(35 * std::numbers::pi / 180));
  // What hangs on the body is turned with it by the 30 degrees of the first row.
  const auto upper =
      read(folder, turntable("angle_table = \"angle.csv\"")).model.bodies[1].initial_pose.rotation;
  CHECK(upper.z() / upper.w() == Approx(std::tan(std::numbers::pi / 12)).epsilon(1e-12));

  CHECK_THAT(refusal(folder, turntable("")), Contains("a turn needs a motion"));
  CHECK_THAT(refusal(folder, turntable("angle = \"t\"\nangle_table = \"angle.csv\"")),
             Contains("motion is given already by 'angle'"));
  CHECK_THAT(refusal(folder, turntable("initial_rate = \"3 m/s\"")),
             Contains("body.ground.turn.initial_rate"));
  write_text(folder / "short.csv", "time [ms], angle [deg]\n0, 30\n50, 35\n100, 37\n150, 30\n");
  CHECK_THAT(refusal(folder, turntable("angle_table = \"short.csv\"")),
             Contains("must cover the run, from 0 to 0.2 s, but are from 0 to 0.15 s"));
  write_text(folder / "back.csv", "time [ms], angle [deg]\n0, 30\n50, 35\n40, 37\n300, 30\n");
  CHECK_THAT(refusal(folder, turntable("angle_table = \"back.csv\"")), Contains("back.csv:4"));
}

TEST_CASE("what a model gets wrong is told in one line with the place and the remedy") {
  const TemporaryFolder folder;
  const std::string good = double_pendulum_text();
  const auto told = [&](const std::string& part, const std::string& by) {
    std::string line = refusal(folder, with(good, part, by));
    CHECK(line.find('\n') == std::string::npos);
    return line;
  };
  CHECK_THAT(told("lower = \"upper.end\"", "lower = \"uper.end\""),
             Contains("model.toml:") && Contains("joint.elbow.lower: there is no marker 'uper.end' "
                                                 "(did you mean 'upper.end'?)"));
  CHECK_THAT(told("body = \"lower\"", "body = \"lowr\""), Contains("did you mean 'lower'?"));
  CHECK_THAT(told("kind = \"pin\"", "kind = \"pim\""), Contains("did you mean 'pin'?"));
  CHECK_THAT(told("mass = \"2 kg\"", "mas = \"2 kg\""),
             Contains("body.upper.mass: expected this key, found none; is 'mas' meant to be it?"));
  CHECK_THAT(told("mass = \"2 kg\"", "mass = \"2 m\""), Contains("measures something else"));
  CHECK_THAT(told("mass = \"2 kg\"", "mass = \"nan kg\""), Contains("body.upper.mass"));
  CHECK_THAT(told("mass = \"2 kg\"", "mass = \"-2 kg\""),
             Contains("body 'upper': mass must be positive"));
  CHECK_THAT(told("\"0.03 kg*m^2\", \"0.03 kg*m^2\", \"0.01 kg*m^2\"",
                  "\"0.03 kg*m^2\", \"0.03 kg*m^2\", \"0.07 kg*m^2\""),
             Contains("no body has the principal moments of inertia"));
  CHECK_THAT(told("\"0.03 kg*m^2\", \"0.03 kg*m^2\", \"0.01 kg*m^2\"",
                  "\"0.03 kg*m^2\", \"0.03 kg*m^2\", \"-0.01 kg*m^2\""),
             Contains("principal moment of inertia may be negative"));
  CHECK_THAT(told("kind = \"pin\"", "kind = \"ball\""), Contains("angle: unknown key"));
  CHECK_THAT(told("lower = \"ground.hook\"", "lower = \"lower.tip\""),
             Contains("no joint or section connects the body 'upper'"));
  CHECK_THAT(
      told("interval = \"1 ms\"", "interval = \"1 ms\"\nmarkers = [\"lower.tipp\"]"),
      Contains("output.markers: there is no marker 'lower.tipp' (did you mean 'lower.tip'?)"));
  CHECK_THAT(told("name = \"lower\"\nkind",
                  "name = \"lower\"\nposition = [\"1 m\", \"0 m\", \"0 m\"]\nkind"),
             Contains("joint 'elbow': angle = ") && Contains("but body 'lower' with position") &&
                 Contains("leave one of them out"));
  CHECK_THAT(refusal(folder, good + "\n[[channel]]\nname = \"c\"\nquantity = \"velocity\"\n"
                                    "marker = \"lower.tip\"\nfilter = \"CFC 1000\"\n"),
             Contains("channel.c.filter: CFC 1000 needs at least 10000 samples per second"));
  CHECK_THAT(refusal(folder, "[solver]\nend_time = \"1 s\"\n"), Contains("expected bodies"));
}

TEST_CASE("a body that two prescribed ones hold is prescribed twice") {
  const TemporaryFolder folder;
  const std::string sled = R"(
[[body]]
name = "sled"
kind = "prescribed"
initial_velocity = "1 m/s"
)";
  CHECK_THAT(refusal(folder, double_pendulum_text() + sled + origin_marker_text("sled", "seat") +
                                 box_text("box", "foot") +
                                 fixed_joint_text("one", "sled.seat", "box.foot") +
                                 fixed_joint_text("two", "ground.hook", "box.foot")),
             Contains("the motion of body 'box' is prescribed twice: joint 'one' fixes it to "
                      "'sled' and joint 'two' "
                      "to 'ground'"));
}

TEST_CASE("a CSV file that is not sound is told with its line") {
  const TemporaryFolder folder;
  const auto told = [&](const std::string& text) {
    try {
      read_csv_columns(write_text(folder / "t.csv", text), "s", "N", "");
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("nothing was refused");
  };
  CHECK(told("time [s], load [N]\n0, 0\n1, 2\n") == "nothing was refused");
  CHECK_THAT(told("time [s], load [N]\n0, 0\n1, 2\n1, 3\n"),
             Contains("t.csv:4: the column 'time' must increase strictly"));
  CHECK_THAT(told("time [s], load [m]\n0, 0\n"),
             Contains("t.csv:1: column \"load [m]\"") && Contains("measures something else"));
  CHECK_THAT(told("time [s], load\n0, 0\n"), Contains("a column's name and unit"));
  CHECK_THAT(told("time [s], load [N]\n0, x\n"), Contains("t.csv:2: expected a finite number"));
  CHECK_THAT(told("time [s], load [N]\n0, nan\n"), Contains("finite number, found \"nan\""));
  CHECK_THAT(told("time [s], load [N]\n0\n"),
             Contains("t.csv:2: expected 2 cells") && Contains("found 1"));
  CHECK_THAT(told("time [s], a [N], b [N]\n0, 1, 2\n"),
             Contains("choose one of 'a', 'b' with the key 'column'"));
  CHECK_THAT(told("time [s], load [N]\n"), Contains("expected rows"));
  CHECK_THROWS_WITH(read_csv_columns(folder / "none.csv", "s", "N", ""), Contains("none.csv"));
}

TEST_CASE("surplus cells, decimal commas and other separators of a CSV file are refused") {
  const TemporaryFolder folder;
  const auto columns = [&](const std::string& text, const std::string& column = "") {
    return read_csv_columns(write_text(folder / "t.csv", text), "s", "N", column);
  };
  const std::string names = "time [s], load [N]\n";
  const auto refused = [&](const std::string& text, const std::string& why) {
    INFO(text);
    CHECK_THROWS_WITH(columns(text), Contains(why));
  };
  refused(names + "0, 1\n10, 24,15\n",
          "t.csv:3: expected 2 cells as in the line of names, found 3; "
          "commas stand between cells, and decimals have a point");
  refused(names + "0, 1,\n", "t.csv:2: expected 2 cells");
  refused(names + "0 1\n", "decimals have a point");
  refused("time [s]; load [N]\n0; 1\n", "commas stand between cells");
  refused("time [s]\tload [N]\n0\t1\n", "commas stand between cells");
  refused(names + "0, 1;5\n", "decimals have a point");
  refused(names + "0, 1\r1, 2\r", "lines that end in LF or CRLF");
  refused(names + "0, 0x10\n", "expected a finite number");
  refused(names + "0, 1e999\n", "expected a finite number");
  refused("time [s], load [Mt km/s^2]\n0, 1e302\n", "expected a finite number");
  refused(names + std::string("0, 1\0\n", 6), "found \\x00");
  refused("time [2 s], load [N]\n0, 1\n", "no number stands within a unit");
  CHECK_THROWS_WITH(columns("time [s], a [N], a [N]\n0, 1, 2\n", "a"),
                    Contains("several columns 'a'"));
  const TableColumns same =
      columns("\xEF\xBB\xBF" + ("# mine\r\n\r\n" + names) + "0, 1\r\n \n1,\t2");
  CHECK(same.x == std::vector<double>{0, 1});
  CHECK(same.y == std::vector<double>{1, 2});
}

TEST_CASE("modes of a deformable body are chosen by name, damped one by one, and may be offset") {
  const TemporaryFolder folder;
  testing::write_beam_modes(folder / "beam.h5");
  const auto beam = [&](const std::string& keys) {
    return R"(
[solver]
end_time = "10 ms"
[[body]]
name = "ground"
kind = "ground"
)" + origin_marker_text("ground", "bench") +
           R"(
[[body]]
name = "beam"
kind = "deformable"
modes_file = "beam.h5"
)" + keys + R"(
[[marker]]
body = "beam"
name = "turned tip"
interface = "top"
rotation = ["0 deg", "0 deg", "90 deg"]
)" + box_text("weight", "face") +
           fixed_joint_text("clamp", "ground.bench", "beam.base") +
           fixed_joint_text("tip", "beam.turned tip", "weight.face");
  };
  const std::string two = "modes = [\"lateral bending 1\", \"fore-aft bending 1\"]\n";
  const ModelFile file =
      read(folder, beam(two + "damping_ratio = [0.1, 0.2]\noffset = [0.0, 0.01]"));
  const auto& body = std::get<multibody::DeformableBody>(file.model.bodies[1].kind);
  CHECK(body.modes.modes[0].name == "lateral bending 1");
  CHECK(body.damping_ratio[1] == 0.2);
  // The weight sits on the tip of the bent beam, turned with it: and so it stays.
  CHECK(file.model.bodies[2].initial_pose.position_m.x() ==
        Approx(0.01 * body.modes.interface("top").translation(0, 1)));
  const multibody::History history =
      multibody::simulate(file.model, file.solver, {file.end_time_s, 1e-3});
  CHECK((history.modal[0].coordinates.colwise() - history.modal[0].coordinates.col(0))
            .cwiseAbs()
            .maxCoeff() < 1e-12);

  CHECK_THAT(refusal(folder, beam("modes = [\"lateral bending 3\"]\ndamping_ratio = 0.1")),
             Contains("body.beam.modes: ") && Contains("did you mean 'lateral bending"));
  CHECK_THAT(refusal(folder, beam(two + "damping_ratio = [0.1]")), Contains("list of 2 entries"));
  CHECK_THAT(refusal(folder, with(beam("damping_ratio = 0.1"), "beam.h5", "none.h5")),
             Contains("none.h5: no such file; make it with 'flexneck modes'"));
  // Of a later version, of another kind, not mass-normalised, not finite.
  const auto wrote = [&](const FileFormat& format) {
    Hdf5Writer(folder / "beam.h5", format).commit();
    return refusal(folder, beam("damping_ratio = 0.1"));
  };
  const FileFormat& known = fe_modal::kModalBodyFormat;
  CHECK_THAT(wrote({known.name, known.schema_version + 1, known.made_by}),
             Contains("beam.h5") && Contains("schema_version"));
  CHECK_THAT(wrote(multibody::kHistoryFormat), Contains("beam.h5") && Contains("flexneck history"));
  const auto spoilt = [&](double value) {
    fe_modal::ModalBodyFile beam_file;
    beam_file.body = testing::make_beam_body(testing::Beam());
    beam_file.body.invariants.Maa(0, 0) = value;
    fe_modal::write_modal_body(folder / "beam.h5", beam_file);
    return refusal(folder, beam("damping_ratio = 0.1"));
  };
  CHECK_THAT(spoilt(1.01), Contains("beam.h5") && Contains("not mass-normalised"));
  CHECK_THAT(spoilt(std::nan("")), Contains("beam.h5"));
  write_text(folder / "beam.h5", "not HDF5");
  CHECK_THAT(refusal(folder, beam("damping_ratio = 0.1")), Contains("beam.h5"));
}

TEST_CASE("a start that is said twice must be the same both times") {
  const TemporaryFolder folder;
  const std::string upper = "name = \"upper\"\nkind = \"rigid\"\n";
  const auto told = [&](const std::string& more) {
    return refusal(folder, with(double_pendulum_text(), upper, upper + more));
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
    CHECK_THAT(refusal(folder, with(double_pendulum_text(), solver, solver + rest + "\n")),
               Contains("joint 'shoulder': rate = 5.23599 rad/s") && Contains(rest));
}
