// SPDX-License-Identifier: GPL-3.0-or-later
// The certification test's neck, rigid plates with sections made from submeshes of the rubber, on
// the coarsest mesh that can be slit.
#include <cmath>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "fe_modal/body/modal_body_file.h"
#include "geometry/foundation/error.h"
#include "geometry/foundation/names.h"
#include "geometry/foundation/temporary_folder.h"
#include "mesher/mesh/mesh_file.h"
#include "multibody/analysis/linearisation.h"
#include "multibody/joints/joint_kinds.h"
#include "pipeline/experiments/case_model.h"
#include "pipeline/experiments/pendulum.h"
#include "pipeline/experiments/relaxation_table.h"
#include "pipeline/experiments/test_curves.h"
#include "pipeline/laboratory/verdict/verdict.h"
#include "pipeline/parameter_studies/evaluation/pieces_of_cases.h"
#include "pipeline/results/report/plate_motion.h"
#include "tests/support/flexneck_command.h"

using namespace flexneck;
using namespace flexneck::pipeline;
using Settings = std::vector<std::string>;

namespace {

const Settings kCoarse = {"mesh.quadrant=2", "mesh.inner_ring=2", "mesh.rubber_layers=2",
                          "geometry.bolt_patch_radius=0.4 in"};

/// The neck and its submeshes, made by the command.
class Made {
 public:
  explicit Made(const Settings& settings, const Settings& mesh = kCoarse) : settings_(settings) {
    settings_.insert(settings_.end(), mesh.begin(), mesh.end());
    std::string line =
        " " + built_in_qualification().string() + " -q -o " + folder_.path().string();
    for (const std::string& each : settings_) line += " --set '" + each + "'";
    for (const char* const stage : {"mesh", "modes"}) {
      const testing::CommandOutcome outcome = testing::run_flexneck(stage + line);
      INFO(outcome.text);
      REQUIRE(outcome.exit_code == 0);
    }
  }

  mesher::Mesh mesh() const { return mesher::read_mesh(folder_ / "mesh.h5").mesh; }
  fe_modal::ModalBody whole() const { return body("modes"); }
  /// The study with its submeshes.
  Study study(const Settings& more = {}) const {
    Settings all = settings_;
    all.insert(all.end(), more.begin(), more.end());
    Pieces pieces;
    for (const char* const disc : {"disc_1", "disc_2", "disc_3", "disc_4"})
      pieces.emplace(disc, body("substructure_" + std::string(disc)));
    return with_pieces(read_study(built_in_qualification(), all), pieces);
  }

 private:
  fe_modal::ModalBody body(const std::string& name) const {
    return fe_modal::read_modal_body(folder_ / (name + ".h5")).body;
  }

  TemporaryFolder folder_;
  Settings settings_;
};

const CaseSection& flexion(const Study& study) {
  return study.cases[find_name(names_of(study.cases), "certification-flexion", "case")];
}

/// Frequencies of head and neck on an arm at rest, the nodding joint locked, without gravity.
std::vector<multibody::SystemMode> modes_of_chain(const Study& study) {
  multibody::Model model = case_model(flexion(study), {});
  model.gravity_m_s2.setZero();
  for (multibody::Joint& joint : model.joints) joint.kind = &multibody::kFixedJoint;
  model.forces.of<multibody::JointResistance>().clear();
  return multibody::system_modes(model);
}

}  // namespace

TEST_CASE("rigid plates and sections swing under the head as the finite element neck does") {
  const std::string slits = GENERATE("closed", "open");
  const Made made({"geometry.slits=" + slits, "substructures.slits=cracks"});
  // The relaxing share is negligible.
  const Study study = made.study({"variables.relaxing_share=1e-6"});
  const std::vector<multibody::SystemMode> found = modes_of_chain(study);
  const fe_modal::ModalBody whole = made.whole();
  const Eigen::VectorXd& expected = whole.attached.front().frequencies_Hz;
  for (std::size_t k = 0; k < 3; ++k) {
    CAPTURE(slits, k);
    CHECK(found.at(k).frequency_Hz == Approx(expected[static_cast<Eigen::Index>(k)]).epsilon(0.01));
  }
  double mass_kg = 0;
  for (const multibody::Body& body : flexion(study).model.model.bodies)
    if (const auto* rigid = std::get_if<multibody::RigidBody>(&body.kind);
        rigid && body.name != "head")
      mass_kg += rigid->mass_kg;
  CHECK(mass_kg == Approx(whole.invariants.mass).epsilon(1e-9));
}

namespace {

std::vector<JudgedFigure> figures_of(const Study& study, const TestSection& test,
                                     const PendulumRun& run) {
  const CaseSection& experiment =
      study.cases[find_name(names_of(study.cases), test.experiment, "case")];
  return judged(test.rules, test_curves(study, test, experiment, run.history.time_s, run.channels))
      .figures;
}

}  // namespace

TEST_CASE("the built-in neck passes its certification test, all twelve figures well inside") {
  const Made made({}, {});
  const Study study = made.study();
  REQUIRE(study.tests.size() == 2);
  for (const TestSection& test : study.tests) {
    const CaseSection& experiment =
        study.cases[find_name(names_of(study.cases), test.experiment, "case")];
    const PendulumRun run = run_pendulum(study, experiment, {});
    const std::vector<JudgedFigure> figures = figures_of(study, test, run);
    REQUIRE(figures.size() == 6);
    for (const JudgedFigure& figure : figures) {
      CAPTURE(test.name, figure.name);
      CHECK(std::abs(figure.half_corridors().value()) < 0.5);
    }
  }
}

TEST_CASE("the report tells loss factor and storage of the relaxing rubber, and where it is none") {
  const ResultTable table = relaxation_table(
      Made({}).study({"variables.relaxing_share=0.39", "variables.relaxation_time=29 ms"}));
  REQUIRE(table.rows.size() == 9);
  // One branch at 5 Hz: x = w tau = 0.9111, storage 1 - 0.39 / (1 + x^2), loss 0.39 x / (1 + x^2).
  const std::vector<std::string> expected = {"disc_1, disc_2, disc_3, disc_4", "5", "0.787",
                                             "0.247"};
  CHECK(table.rows[3] == expected);
  CHECK(table.notes.front().find("the branches represent the rubber from 1 to 20 Hz") !=
        std::string::npos);
}

TEST_CASE("the certification test keeps its books, and finer steps change no figure") {
  const Made made({});
  const auto figures = [&](const std::string& tolerance) {
    const Study study = made.study({"solver.relative_tolerance=" + tolerance});
    const PendulumRun run = run_pendulum(study, flexion(study), {});
    REQUIRE(run.history.incomplete.empty());
    const multibody::EnergyHistory& energy = run.history.energy;
    const Eigen::VectorXd balance = energy.kinetic_J + energy.strain_J + energy.gravitational_J +
                                    energy.dissipated_J - energy.work_J;
    CHECK((balance.array() - balance[0]).abs().maxCoeff() <
          1e-3 * (energy.kinetic_J.maxCoeff() - energy.kinetic_J.minCoeff()));
    return figures_of(study, study.tests.front(), run);
  };
  const std::vector<JudgedFigure> coarse = figures("1e-6");
  const std::vector<JudgedFigure> fine = figures("1e-7");
  REQUIRE(coarse.size() == 6);
  for (std::size_t k = 0; k < coarse.size(); ++k) {
    CAPTURE(coarse[k].name);
    CHECK(std::abs(coarse[k].half_corridors().value() - fine[k].half_corridors().value()) < 0.01);
  }
}

TEST_CASE("friction in the slits holds the neck, keeps the books, and vanishes as it should") {
  const Made made({});
  const auto peak_rad = [&](const std::string& friction) {
    const Study study = made.study({"variables.slit_friction=" + friction});
    const PendulumRun run = run_pendulum(study, flexion(study), {});
    REQUIRE(run.history.incomplete.empty());
    const multibody::EnergyHistory& energy = run.history.energy;
    const Eigen::VectorXd balance = energy.kinetic_J + energy.strain_J + energy.gravitational_J +
                                    energy.dissipated_J - energy.work_J;
    CHECK((balance.array() - balance[0]).abs().maxCoeff() <
          2e-3 * (energy.kinetic_J.maxCoeff() - energy.kinetic_J.minCoeff()));
    return figures_of(study, study.tests.front(), run).front().value.value();
  };
  const double none = peak_rad("0");
  const double held = peak_rad("1000");
  CHECK(held < none * (1 - 1e-4));
  CHECK(peak_rad("1e-6") == Approx(none).epsilon(1e-3));
  const double some = peak_rad("0.02");
  CHECK((held * (1 - 1e-5) < some && some < none * (1 + 1e-3)));
}

TEST_CASE("the report moves the mesh of a neck of plates as its markers move") {
  const Made made({});
  const Study study =
      read_study(built_in_qualification(), {});  // without pieces, as reports have it
  const mesher::Mesh mesh = made.mesh();
  const mesher::Surface surface = mesher::surface_of(mesh, 2000);
  const std::optional<Plates> plates = plates_of(study, flexion(study), mesh, surface);
  REQUIRE(plates);
  REQUIRE(plates->markers.size() == 5);
  CHECK(plates->share.minCoeff() == 0);
  CHECK(plates->share.maxCoeff() == 1);
  for (std::size_t v = 0; v < plates->section.size(); ++v) {
    const std::string& part = mesh.blocks[surface.block_of_vertex[v]].part;
    const float share = plates->share[static_cast<Eigen::Index>(v)];
    if (part == "base_plate") CHECK((plates->section[v] == 0 && share == 0));
    if (part == "top_plate") CHECK((plates->section[v] == 3 && share == 1));
  }
  const Study complete = made.study();
  const multibody::History history = run_pendulum(complete, flexion(complete), {}).history;
  const Eigen::MatrixXd motion = plate_motion(*plates, history);
  REQUIRE(motion.rows() == 60);
  const Eigen::Matrix<double, 12, 1> rest =
      (Eigen::Matrix<double, 12, 1>() << 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0).finished();
  const Eigen::Index late = 120;  // 60 ms
  for (Eigen::Index plate = 0; plate < 5; ++plate)
    CHECK((motion.col(0).segment<12>(12 * plate) - rest).norm() < 1e-12);
  CHECK((motion.col(late).head<12>() - rest).norm() < 1e-12);
  // The distance from the base to the top.
  const auto& base = history.marker("base_plate.bottom").position_m;
  const auto& top = history.marker("top_plate.condyles").position_m;
  const Eigen::Matrix3d R = Eigen::Map<const Eigen::Matrix3d>(&motion(48, late)).transpose();
  const Eigen::Vector3d length(0, 0, (top.col(0) - base.col(0)).norm());
  const Eigen::Vector3d moved = R * length + motion.col(late).tail<3>();
  CHECK(moved.norm() == Approx((top.col(late) - base.col(late)).norm()).epsilon(1e-3));
  CHECK((R - Eigen::Matrix3d::Identity()).norm() > 0.5);
}
