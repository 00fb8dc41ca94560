// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "geometry/foundation/error.h"
#include "geometry/foundation/hdf5_file.h"
#include "geometry/foundation/temporary_folder.h"
#include "pipeline/language/model/csv_table.h"
#include "pipeline/language/model/model_file.h"
#include "tests/support/modal_files.h"
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
using testing::with;
using testing::write_test_file;

TEST_CASE("bodies are where their joints put them and move as their joints say") {
  const TemporaryFolder folder;
  const ModelFile file = read_model(folder, double_pendulum_text());
  const multibody::Model& model = file.model;
  const multibody::Body& upper = model.bodies[1];
  const multibody::Body& lower = model.bodies[2];
  CHECK((upper.initial_pose.position_m - Eigen::Vector3d(0, 0, 1)).norm() < 1e-15);
  const double angle = 40 * std::numbers::pi / 180;
  const Eigen::Vector3d elbow(-0.4 * std::sin(angle), 0, 1 - 0.4 * std::cos(angle));
  CHECK((lower.initial_pose.position_m - elbow).norm() < 1e-15);
  const double rate = 300 * std::numbers::pi / 180;
  CHECK((upper.initial_angular_velocity_rad_s - Eigen::Vector3d(0, rate, 0)).norm() < 1e-14);
  // It rotates about y with the upper body, and about the elbow's own axis.
  const Eigen::Vector3d turning =
      Eigen::Vector3d(0, rate, 0).cross(elbow - Eigen::Vector3d(0, 0, 1));
  CHECK((lower.initial_velocity_m_s - turning).norm() < 1e-14);
  const Eigen::Vector3d axis = Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitY()) *
                               (Eigen::AngleAxisd(std::numbers::pi / 6, Eigen::Vector3d::UnitZ()) *
                                Eigen::Vector3d::UnitX());
  const Eigen::Vector3d w = lower.initial_pose.rotation * lower.initial_angular_velocity_rad_s;
  CHECK((w - Eigen::Vector3d(0, rate, 0) - 8 * axis).norm() < 1e-14);
  // The joints are therefore satisfied at the start, in position and velocity.
  CHECK(refusal_of_model(folder, double_pendulum_text()) == "nothing was refused");
  CHECK(file.parameters.size() > 30);
}

TEST_CASE("every kind of force is read in its units") {
  const TemporaryFolder folder;
  write_test_file(folder / "load.csv",
                  "# a comment\ntime [ms], idle [1], load [lbf]\n0, 1, 2\n\n5, 1, 4\n");
  const ModelFile file = read_model(folder, double_pendulum_text() + R"(
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

TEST_CASE("what a model gets wrong is told in one line with the place and the remedy") {
  const TemporaryFolder folder;
  const std::string good = double_pendulum_text();
  const auto told = [&](const std::string& part, const std::string& by) {
    std::string line = refusal_of_model(folder, with(good, part, by));
    CHECK(line.find('\n') == std::string::npos);
    return line;
  };
  CHECK_THAT(told("lower = \"upper.end\"", "lower = \"uper.end\""),
             Contains("model.toml:") && Contains("joint.elbow.lower: there is no marker 'uper.end' "
                                                 "(did you mean 'upper.end'?)"));
  CHECK_THAT(told("body = \"lower\"", "body = \"lowr\""), Contains("did you mean 'lower'?"));
  CHECK_THAT(told("kind = \"pin\"", "kind = \"pim\""), Contains("did you mean 'pin'?"));
  CHECK_THAT(
      told("mass = \"2 kg\"", "mas = \"2 kg\""),
      Contains("body.upper.mass: expected this key, found none; is 'mas' a misspelling of it?"));
  CHECK_THAT(told("mass = \"2 kg\"", "mass = \"2 m\""), Contains("has another dimension"));
  CHECK_THAT(told("mass = \"2 kg\"", "mass = \"nan kg\""), Contains("body.upper.mass"));
  CHECK_THAT(told("mass = \"2 kg\"", "mass = \"-2 kg\""),
             Contains("body 'upper': mass must be positive"));
  CHECK_THAT(told("\"0.03 kg*m^2\", \"0.03 kg*m^2\", \"0.01 kg*m^2\"",
                  "\"0.03 kg*m^2\", \"0.03 kg*m^2\", \"0.07 kg*m^2\""),
             Contains("the principal moments of inertia are physically impossible"));
  CHECK_THAT(told("\"0.03 kg*m^2\", \"0.03 kg*m^2\", \"0.01 kg*m^2\"",
                  "\"0.03 kg*m^2\", \"0.03 kg*m^2\", \"-0.01 kg*m^2\""),
             Contains("principal moment of inertia may be negative"));
  CHECK_THAT(told("kind = \"pin\"", "kind = \"ball\""),
             Contains("joint.shoulder.angle: has no effect with kind = 'ball'"));
  CHECK_THAT(told("lower = \"ground.hook\"", "lower = \"lower.tip\""),
             Contains("the position of body 'upper' is not determined"));
  CHECK_THAT(
      told("interval = \"1 ms\"", "interval = \"1 ms\"\nmarkers = [\"lower.tipp\"]"),
      Contains("output.markers: there is no marker 'lower.tipp' (did you mean 'lower.tip'?)"));
  CHECK_THAT(told("name = \"lower\"\nkind",
                  "name = \"lower\"\nposition = [\"1 m\", \"0 m\", \"0 m\"]\nkind"),
             Contains("joint 'elbow': angle = ") &&
                 Contains("contradicts body 'lower' with position") &&
                 Contains("remove one of them"));
  CHECK_THAT(
      refusal_of_model(folder, good + "\n[[channel]]\nname = \"c\"\nquantity = \"velocity\"\n"
                                      "marker = \"lower.tip\"\nfilter = \"CFC 1000\"\n"),
      Contains("channel.c.filter: CFC 1000 needs at least 10000 samples per second"));
  CHECK_THAT(refusal_of_model(folder, "[solver]\nend_time = \"1 s\"\n"),
             Contains("expected bodies"));
}

TEST_CASE("a key of a model that another key's value leaves without effect is refused") {
  const TemporaryFolder folder;
  const auto told = [&](const std::string& more) {
    return refusal_of_model(folder, double_pendulum_text() + more);
  };
  const std::string force =
      "[[force]]\nname = \"f\"\nmarker = \"lower.tip\"\ndirection = [1, 0, 0]\n";
  const std::string resistance =
      "[[resistance]]\nname = \"r\"\njoint = \"elbow\"\ncoordinate = \"angle\"\n";
  CHECK(told(force + "magnitude = \"1 N\"\n") == "nothing was refused");
  CHECK_THAT(told(force + "magnitude = \"1 N\"\noutside = \"zero\"\n"),
             Contains("force.f.outside: the load is already given by 'magnitude'"));
  CHECK_THAT(told(force + "magnitude = \"1 N\"\nmagnitudes = [\"1 N\"]\n"),
             Contains("force.f.magnitudes: the load is already given"));
  CHECK_THAT(told(resistance + "stiffness = \"1 N m/rad\"\nstop_stiffness = \"1 N m/rad\"\n"),
             Contains("resistance.r.stop_stiffness: has no effect without 'stop'"));
  CHECK_THAT(told(resistance + "stiffness = \"1 N m/rad\"\npositive = { stiffness = \"1 N m/rad\" "
                               "}\nnegative = { stiffness = \"1 N m/rad\" }\n"),
             Contains("resistance.r.stiffness: has no effect beside [positive] and [negative]"));
  const auto quasi_static = [&](const std::string& key) {
    return refusal_of_model(folder, with(double_pendulum_text(), "[solver]\n",
                                         "[solver]\nanalysis = \"quasi_static\"\n" + key));
  };
  CHECK_THAT(quasi_static("max_step = \"1 ms\"\n"),
             Contains("solver.max_step: has no effect in a quasi-static analysis"));
  CHECK_THAT(quasi_static("integrator = \"dormand_prince\"\n"), Contains("solver.integrator:"));
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
      read_model(folder, beam(two + "damping_ratio = [0.1, 0.2]\noffset = [0.0, 0.01]"));
  const auto& body = std::get<multibody::DeformableBody>(file.model.bodies[1].kind);
  CHECK(body.modes.modes[0].name == "lateral bending 1");
  CHECK(body.damping_ratio[1] == 0.2);
  // The weight is at the tip of the bent beam, rotated with it, and stays there.
  CHECK(file.model.bodies[2].initial_pose.position_m.x() ==
        Approx(0.01 * body.modes.interface("top").translation(0, 1)));
  const multibody::History history =
      multibody::simulate(file.model, file.solver, {file.end_time_s, 1e-3});
  CHECK((history.modal[0].coordinates.colwise() - history.modal[0].coordinates.col(0))
            .cwiseAbs()
            .maxCoeff() < 1e-12);

  CHECK_THAT(refusal_of_model(folder, beam("modes = [\"lateral bending 3\"]\ndamping_ratio = 0.1")),
             Contains("body.beam.modes: ") && Contains("did you mean 'lateral bending"));
  CHECK_THAT(refusal_of_model(folder, beam(two + "damping_ratio = [0.1]")),
             Contains("list of 2 entries"));
  CHECK_THAT(refusal_of_model(folder, with(beam("damping_ratio = 0.1"), "beam.h5", "none.h5")),
             Contains("none.h5: no such file; make it with 'flexneck modes'"));
  // Files of a later version, of another kind, not mass-normalised, not finite.
  const auto wrote = [&](const FileFormat& format) {
    Hdf5Writer(folder / "beam.h5", format).commit();
    return refusal_of_model(folder, beam("damping_ratio = 0.1"));
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
    return refusal_of_model(folder, beam("damping_ratio = 0.1"));
  };
  CHECK_THAT(spoilt(1.01), Contains("beam.h5") && Contains("not mass-normalised"));
  CHECK_THAT(spoilt(std::nan("")), Contains("beam.h5"));
  write_test_file(folder / "beam.h5", "not HDF5");
  CHECK_THAT(refusal_of_model(folder, beam("damping_ratio = 0.1")), Contains("beam.h5"));
}
