// SPDX-License-Identifier: GPL-3.0-or-later
// Cases as models: the tables of a study that they use, and their changes and additions.
#include <fstream>
#include <stdexcept>

#include <catch2/catch.hpp>

#include "geometry/foundation/names.h"
#include "geometry/foundation/temporary_folder.h"
#include "multibody/joints/joint_kinds.h"
#include "pipeline/experiments/case_model.h"
#include "pipeline/experiments/static_chain.h"
#include "pipeline/run/results_folder.h"
#include "tests/support/beam_experiment.h"
#include "tests/support/flexneck_command.h"
#include "tests/support/modal_files.h"

namespace flexneck::pipeline {
namespace {

using Catch::Matchers::Contains;
using multibody::JointResistance;
using multibody::Model;

/// A study that includes the built-in one.
class OwnStudy {
 public:
  Study read(const std::string& text, const std::vector<std::string>& settings = {}) const {
    std::ofstream(folder_ / "study.toml") << "include = [\"" << built_in_study().string() << "\"]\n"
                                          << text;
    return read_study(folder_ / "study.toml", settings);
  }
  void refuses(const std::string& text, const std::string& reason) const {
    INFO(text);
    CHECK_THROWS_WITH(read(text), Contains(reason));
  }
  std::filesystem::path operator/(const std::string& name) const { return folder_ / name; }

 private:
  TemporaryFolder folder_;
};

const CaseSection& named(const Study& study, const std::string& name) {
  return study.cases[find_name(names_of(study.cases), name, "case")];
}

const Model& model_of(const Study& study, const std::string& name) {
  return named(study, name).model.model;
}

const multibody::Joint& joint(const Model& model, const std::string& name) {
  return model.joints[find_name(names_of(model.joints), name, "joint")];
}

}  // namespace

TEST_CASE("a case has the bodies that it names, their markers, and the joints between them") {
  const Study study = read_study(built_in_study(), {});
  const Model& pendulum = model_of(study, "flexion-60");
  CHECK(names_of(pendulum.bodies) == std::vector<std::string>{"neck", "head", "arm"});
  CHECK(names_of(pendulum.joints) == std::vector<std::string>{"j1", "j2"});
  CHECK(pendulum.forces.of<multibody::PointForce>().empty());
  const Model& tester = model_of(study, "extension");
  CHECK(names_of(tester.bodies) == std::vector<std::string>{"neck", "ground"});
  CHECK(names_of(tester.joints) == std::vector<std::string>{"clamp"});
  REQUIRE(tester.forces.of<multibody::PointForce>().size() == 1);
  CHECK(tester.forces.of<multibody::PointForce>()[0].direction == -Eigen::Vector3d::UnitX());
  // The whole model of the study is kept for a report or an attached body.
  CHECK(study.model.model.bodies.size() == 4);
  CHECK(study.rigid_body("head").mass_kg == Approx(9.921 * 0.45359237));
}

TEST_CASE("tables of a case change those of the study key by key, or are added") {
  const OwnStudy own;
  const Study study = own.read(R"(
[[case]]
name = "flexion-60"
[[case.body]]
name = "head"
mass = "5 kg"
[[case.marker]]
body = "head"
name = "ear"
position = ["0 mm", "80 mm", "60 mm"]
[[case.resistance]]
name = "neck muscle"
joint = "j2"
coordinate = "angle"
stiffness = "3 N*m/rad"
[[case.joint]]
name = "j2"
kind = "revolute"
axis = [0, 1, 0]
)");
  const Model& changed = model_of(study, "flexion-60");
  const auto& head =
      std::get<multibody::RigidBody>(changed.bodies[changed.body_index("head")].kind);
  CHECK(head.mass_kg == 5);
  CHECK(head.center_m == study.rigid_body("head").center_m);
  CHECK(changed.markers[changed.marker_index("head.ear")].position_m.y() == Approx(0.08));
  CHECK(joint(changed, "j2").kind == &multibody::kRevoluteJoint);
  CHECK(changed.markers[joint(changed, "j2").marker_i].name == "neck.top");
  REQUIRE(changed.forces.of<JointResistance>().size() == 1);
  // Another case of the study is unchanged; a variant of this one has its changes and the variant's
  // own.
  const Model& other = model_of(study, "flexion-80");
  CHECK(joint(other, "j2").kind == &multibody::kFixedJoint);
  CHECK(other.forces.of<JointResistance>().empty());
  const Model& variant = model_of(study, "flexion-60-spring");
  CHECK(std::get<multibody::RigidBody>(variant.bodies[variant.body_index("head")].kind).mass_kg ==
        5);
  CHECK(variant.forces.of<JointResistance>().size() == 2);
  const Provenance provenance = case_provenance(study, named(study, "flexion-60"));
  const auto value = [&](const std::string& key) {
    for (const Parameter& each : provenance.parameters)
      if (each.key == key) return each.value;
    return std::string("none");
  };
  CHECK(value("case.flexion-60.body.head.mass") == "5 kg");
  CHECK(value("case.flexion-60.resistance.neck muscle.stiffness") == "3 N*m/rad");
}

TEST_CASE("a body of a study may have the modes of a file in place of its structure's") {
  const OwnStudy own;
  testing::write_beam_modes(own / "beam.h5");
  const Study study = own.read("[[body]]\nname = \"neck\"\nmodes_file = \"beam.h5\"\nmodes = []\n");
  const Model& model = model_of(study, "flexion-60");
  const auto& neck =
      std::get<multibody::DeformableBody>(model.bodies[model.body_index("neck")].kind);
  CHECK(neck.modes.mode_count() == testing::make_beam_body(testing::Beam()).mode_count());
  CHECK(named(study, "flexion-60").model.of_structure.empty());
  REQUIRE(!study.tables.empty());
  CHECK(study.tables.front().name == "beam.h5");
}

TEST_CASE("what a case's model gets wrong is refused with file, line and key") {
  const OwnStudy own;
  const std::string flexion = "[[case]]\nname = \"flexion-60\"\n";
  own.refuses(flexion + "bodies = [\"arm\", \"nek\", \"head\"]\n",
              "study.toml:4:10: case.flexion-60.bodies: there is no body 'nek' (did you mean "
              "'neck'?)");
  own.refuses(flexion + "forces = [\"forward laod\"]\n", "did you mean 'forward load'?");
  own.refuses(flexion + "[[case.joint]]\nname = \"j2\"\nkind = \"revolut\"\n",
              "study.toml:6:8: case.flexion-60.joint.j2.kind: expected one of");
  own.refuses(flexion + "[[case.joint]]\nname = \"j2\"\nkindd = \"revolute\"\n",
              "case.flexion-60.joint.j2.kindd: unknown key (did you mean 'kind'?)");
  own.refuses(flexion + "[[case.joint]]\nname = \"j3\"\nkind = \"fixed\"\n",
              "case.flexion-60.joint.j3.lower: expected this key");
  own.refuses(flexion + "[[case.body]]\nname = \"arm\"\ninitial_velocity = \"1 m/s\"\n",
              "case.flexion-60.body.arm.initial_velocity: has no effect, since the case determines "
              "the motion of this body");
  own.refuses(flexion + "bodies = [\"neck\", \"head\"]\n",
              "expected one body of kind \"prescribed\", the pendulum's arm, found 0");
  // Errors are also found in a table that others override in every case, and in one that no case
  // uses.
  own.refuses(flexion +
                  "[[case.joint]]\nname = \"j2\"\naxes = [0, 1, 0]\n"
                  "[[variant]]\nname = \"other\"\nof = [\"flexion-60\"]\n"
                  "[[variant.joint]]\nname = \"j2\"\nkind = \"fixed\"\n",
              "case.flexion-60.joint.j2.axes: unknown key");
  own.refuses("[[body]]\nname = \"spare\"\nkind = \"rigid\"\nmass = \"1 s\"\n",
              "study.toml:5:8: body.spare.mass: ");
  own.refuses(
      "[[marker]]\nbody = \"hed\"\nname = \"ear\"\nposition = [\"0 m\", \"0 m\", \"0 m\"]\n",
      "did you mean 'head'?");
}

TEST_CASE("a case that starts at rest is refused bodies and joints that move") {
  const testing::BeamExperiment moving({R"(body.head.velocity=["1 m/s", "0 m/s", "0 m/s"])"});
  CHECK_THROWS_WITH(case_model(moving.named("flexion-60"), moving.body),
                    Contains("case.flexion-60: body 'head': velocity = (1, 0, 0) m/s") &&
                        Contains("the case starts at rest"));
  const testing::BeamExperiment turning({"variant.spring.joint.j2.rate=2 rad/s"});
  CHECK_THROWS_WITH(case_model(turning.named("flexion-60-spring"), turning.body),
                    Contains("joint 'j2': rate = 2 rad/s"));
  CHECK_NOTHROW(case_model(turning.named("flexion-60"), turning.body));
}

TEST_CASE("a chain of substructures is refused a model that it cannot stand for") {
  const Study study =
      read_study(built_in_study(), {R"(case.flexion.bodies=["ground", "neck", "head"])"});
  CHECK_THROWS_WITH(static_chain_model(named(study, "flexion"), {}),
                    Contains("case.flexion: a chain of substructures can replace only a neck"));
}

TEST_CASE("a study runs all of its cases, some or none") {
  const auto selected = [](const std::string& list) {
    return names_of(read_study(built_in_study(), {"cases=" + list}).cases);
  };
  using Names = std::vector<std::string>;
  CHECK(selected("[]").empty());
  CHECK(selected("['flexion', 'lateral-65']") == Names{"flexion", "lateral-65"});
  CHECK(selected("['flexion-60-spring']") == Names{"flexion-60", "flexion-60-spring"});
  CHECK(selected("['extension*']").size() == 20);
  const Study study = read_study(built_in_study(), {"cases=['flexion-120']"});
  CHECK(names_of(study.tests) == Names{"flexion"});
  CHECK_THROWS_WITH(selected("['flexion-61']"),
                    Contains("cases: there is no case 'flexion-61'") && Contains("did you mean"));
  testing::check_refused(testing::run_flexneck("run --case flexoin-20"), "did you mean");
  testing::check_refused(testing::run_flexneck("mesh --case flexion-20"),
                         "--case is an option of the command run, qualify, static, pendulum");
}

}  // namespace flexneck::pipeline
