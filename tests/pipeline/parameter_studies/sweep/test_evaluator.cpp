// SPDX-License-Identifier: GPL-3.0-or-later
// Outputs of a study with other values, against the files that the commands write.
#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "fe_modal/body/modal_body_file.h"
#include "geometry/foundation/error.h"
#include "geometry/foundation/temporary_folder.h"
#include "multibody/files/history_file.h"
#include "pipeline/experiments/pendulum.h"
#include "pipeline/experiments/pendulum_signals.h"
#include "pipeline/parameter_studies/evaluation/evaluator.h"
#include "tests/support/beam_study.h"
#include "tests/support/flexneck_command.h"

using Catch::Matchers::Contains;
using namespace flexneck;
using namespace flexneck::pipeline;

namespace {

namespace fs = std::filesystem;

const std::string kDamping = "body.neck.damping_ratio=0.5";
const std::string kMass = "body.head.mass=\"5 kg\"";

/// The evaluator of all tests: a process can have only one PETSc and one console.
Evaluator& evaluator() {
  static const TemporaryFolder folder;
  static const Console console(Verbosity::quiet);
  static Evaluator one({testing::write_beam_study(folder.path()), {}}, console);
  return one;
}

/// Runs the commands on the study with both settings.
void run_commands(const fs::path& study, const fs::path& out) {
  const testing::CommandOutcome outcome =
      testing::run_flexneck("run " + study.string() + " -o " + out.string() + " --set " + kDamping +
                            " --set '" + kMass + "'");
  INFO(outcome.text);
  REQUIRE(outcome.exit_code == 0);
}

}  // namespace

TEST_CASE("an evaluation gives the figures of the files that 'run' writes") {
  const TemporaryFolder folder;
  const fs::path path = testing::write_beam_study(folder.path());
  run_commands(path, folder / "out");
  const fe_modal::ModalBody body = fe_modal::read_modal_body(folder / "out/modes.h5").body;
  const multibody::HistoryFile file = multibody::read_history(folder / "out/pendulum-flexion.h5");
  const Study study = read_study(path, {kDamping, kMass});
  const CaseSection& experiment = study.cases.front();
  const PendulumResult result =
      pendulum_result(study, experiment, file.history.time_s, file.channels);

  const WantedOutputs wanted = evaluator().wanted(
      {"modes.mass", "modes.frequency.fore-aft bending 2", "modes.system_frequency",
       "pendulum.flexion.head_rotation", "pendulum.flexion.occipital_moment_time",
       "pendulum.flexion.head_acceleration", "pendulum.flexion.zero_crossing"},
      {"pendulum.flexion.load cell moment"});
  const Evaluation found = evaluator().evaluate({kDamping, kMass}, wanted);
  CHECK(found.problem.empty());
  CHECK(found.figures[0] == body.invariants.mass);
  CHECK(found.figures[1] == body.frequencies_Hz[body.mode_index("fore-aft bending 2")]);
  CHECK(found.figures[2] == body.attached.front().frequencies_Hz[0]);
  // The filtered channels are part of the same run.
  CHECK(found.figures[3] == result.head_rotation.value);
  CHECK(found.figures[4] == result.occipital_moment.time_s);
  CHECK(found.figures[5] == result.head_acceleration.value);
  REQUIRE(result.zero_crossing_s);
  CHECK(found.figures[6] == *result.zero_crossing_s);
  CHECK(found.times_s[0] == file.history.time_s);
  CHECK(found.curves[0] == channel_named(file.channels, "load cell moment"));
}

TEST_CASE("a run without filtered channels has the same unfiltered ones") {
  const auto curves_with = [&](const std::vector<std::string>& figures) {
    return evaluator()
        .evaluate({}, evaluator().wanted(
                          figures, {"pendulum.far.head rotation", "pendulum.far.base moment"}))
        .curves;
  };
  const std::vector<Eigen::VectorXd> fast = curves_with({"pendulum.far.neck_rotation"});
  const std::vector<Eigen::VectorXd> dense = curves_with({"pendulum.far.head_acceleration"});
  // Both runs have the same steps; the times of outputs differ by rounding.
  for (std::size_t k = 0; k < 2; ++k) {
    REQUIRE(fast[k].size() == dense[k].size());
    CHECK((fast[k] - dense[k]).cwiseAbs().maxCoeff() < 1e-9 * dense[k].cwiseAbs().maxCoeff());
  }
}

TEST_CASE("modes are computed once for all that share their values") {
  const WantedOutputs wanted = evaluator().wanted({"pendulum.flexion.system_frequency"}, {});
  const std::string own = "modes.count=2";  // used by no other test
  const auto solved = [&, before = evaluator().solved_count()] {
    return evaluator().solved_count() - before;
  };
  for (const char* const damping : {"0.5", "0.6", "0.7"})
    evaluator().evaluate({own, std::string("body.neck.damping_ratio=") + damping}, wanted);
  for (const char* const mass : {"4 kg", "5 kg"})
    evaluator().evaluate({own, std::string("body.head.mass=\"") + mass + "\""}, wanted);
  CHECK(solved() == 1);
  for (const char* const count : {"2", "3", "2", "3"})
    evaluator().evaluate({std::string("modes.count=") + count}, wanted);
  CHECK(solved() == 2);
  // The attached head affects these frequencies.
  const WantedOutputs attached = evaluator().wanted({"modes.system_frequency"}, {});
  for (const char* const mass : {"4 kg", "5 kg", "4 kg"})
    evaluator().evaluate({own, std::string("body.head.mass=\"") + mass + "\""}, attached);
  CHECK(solved() == 4);
}

TEST_CASE("a static test has its stiffness, and a verdict its figures") {
  const WantedOutputs wanted =
      evaluator().wanted({"static.pull.initial_stiffness", "verdict.certified.peak rotation",
                          "verdict.certified.peak_rotation", "verdict.certified.figures_inside"},
                         {});
  const Evaluation found = evaluator().evaluate({}, wanted);
  // Small static motions by the modes: M = F L, theta = F sum(mu_y psi_x / omega^2) at the top.
  const TemporaryFolder folder;
  const fs::path path = testing::write_beam_study(folder.path());
  run_commands(path, folder / "out");
  const fe_modal::ModalBody body = fe_modal::read_modal_body(folder / "out/modes.h5").body;
  const fe_modal::Interface& top = body.interface("top");
  double flexibility = 0;
  for (Eigen::Index k = 0; k < body.mode_count(); ++k)
    flexibility += top.rotation(1, k) * top.translation(0, k) /
                   std::pow(2 * std::numbers::pi * body.frequencies_Hz[k], 2);
  CHECK(found.figures[0] == Approx(0.144 / flexibility).epsilon(0.01));
  CHECK(found.figures[1] == found.figures[2]);
  CHECK(found.figures[1] > 0.5);
  CHECK(found.figures[3] == std::floor(found.figures[3]));
}

TEST_CASE("names of nothing that the study gives are refused, each with one line") {
  const auto check_refused = [&](const std::string& name, const std::string& reason) {
    INFO(name);
    CHECK_THROWS_WITH(evaluator().wanted({name}, {}),
                      Contains("output '" + name + "'") && Contains(reason));
  };
  check_refused("mass", "such as modes.mass");
  check_refused("mode.mass", "did you mean 'modes'");
  check_refused("modes.weight", "figure");
  check_refused("pendulum.flexon.head_rotation", "did you mean 'flexion'");
  check_refused("pendulum.flexion.head_rotate", "did you mean 'head_rotation'");
  check_refused("pendulum.pull.head_rotation", "case");
  check_refused("static.pull.stiffness", "figure");
  check_refused("verdict.certified.peak_motion", "figure");
  CHECK_THROWS_WITH(evaluator().wanted({}, {"pendulum.flexion.head"}), Contains("channel"));
  CHECK_THROWS_WITH(evaluator().wanted({}, {"modes.mass"}), Contains("expected a curve"));
  CHECK_THROWS_WITH(
      evaluator().require_produced(evaluator().wanted({"modes.frequency.torsion 1"}, {})),
      Contains("output 'modes.frequency.torsion 1'") && Contains("mode"));
}
