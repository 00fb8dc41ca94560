// SPDX-License-Identifier: GPL-3.0-or-later
// Curves, corridors and ratings as targets: a damping ratio is recovered from its own curve.
#include <cmath>
#include <fstream>

#include "pipeline/laboratory/curve_file.h"
#include "pipeline/laboratory/iso_mme/test_writer.h"
#include "pipeline/parameter_studies/fit/history.h"
#include "tests/pipeline/parameter_studies/fit/closed_models.h"
#include "tests/pipeline/parameter_studies/fit/fit_runs.h"

using Catch::Matchers::Contains;
using namespace flexneck;
using namespace flexneck::testing;
namespace fs = std::filesystem;

namespace {

constexpr double kDamping = 0.7;
/// An output interval short enough for a rating.
const std::string kDense = " --set output.interval=\"'0.5 ms'\"";

/// A run of the beam with a known damping ratio, and fits of it.
class CurveFit {
 public:
  explicit CurveFit(std::string more = "") : more_(std::move(more)), truth_(run_with(kDamping)) {}
  const pipeline::Curve& truth() const { return truth_; }
  /// The head's rotation with a damping ratio, in deg.
  pipeline::Curve run_with(double damping) const {
    require_done("run " + write_beam_study(folder_.path()).string() + " --case flexion -o " +
                 (folder_ / "truth").string() +
                 " --set body.neck.damping_ratio=" + std::to_string(damping) + more_);
    return pipeline::in_unit(
        pipeline::read_curve(folder_ / "truth/pendulum-flexion.csv", "head rotation"), "deg");
  }
  std::ofstream file(const std::string& name) const { return std::ofstream(folder_ / name); }
  fs::path path(const std::string& name) const { return folder_ / name; }

  CommandOutcome fitted(const std::string& target, const std::string& section = "") const {
    const fs::path study = write_beam_study(
        folder_.path(), "[fit]\nstarts = 1\n" + section +
                            "[[fit.parameter]]\nname = \"damping\"\n"
                            "key = \"body.neck.damping_ratio\"\nfrom = 0.3\nto = 1.5\n"
                            "[[fit.target]]\nname = \"rotation\"\n"
                            "curve = \"pendulum.flexion.head rotation\"\n" +
                            target);
    return run_flexneck(fit(study, folder_ / "out", more_));
  }
  double damping(const std::string& target, const std::string& section = "") const {
    const CommandOutcome outcome = fitted(target, section);
    INFO(outcome.text);
    REQUIRE(outcome.exit_code == 0);
    return cell(table_in(folder_ / "out", "fit parameters"), 0, 2);
  }
  void refuses(const std::string& target, const std::string& why) const {
    INFO(target);
    check_refused(fitted(target), why);
  }

 private:
  TemporaryFolder folder_;
  std::string more_;
  pipeline::Curve truth_;
};

const std::string kTable = "table = \"truth/pendulum-flexion.csv\"\ncolumn = \"head rotation\"\n";
const std::string kDegree = "standard_deviation = \"1 deg\"\n";

}  // namespace

TEST_CASE("a curve is fitted at its points") {
  const CurveFit lab;
  CHECK(lab.damping(kTable + kDegree) == Approx(kDamping).epsilon(1e-4));
  CHECK_THAT(bytes_of(lab.path("out/fit-curve-rotation.svg")), Contains("</svg>"));
  lab.refuses(kTable + kDegree + "from = \"100 ms\"\nto = \"900 ms\"\n", "expected a time within");
  lab.refuses(kTable + kDegree + "from = \"100 ms\"\nto = \"50 ms\"\n",
              "expected a time after from");
  lab.refuses(kTable + "standard_deviation = \"1 N\"\n", "rad");
  lab.file("down.csv") << "time [ms],phi [deg]\n0,1\n2,2\n1,3\n";
  lab.refuses("table = \"down.csv\"\n" + kDegree, "increas");
}

TEST_CASE("a channel of an ISO-MME test is a target, with another time zero and a filter") {
  const CurveFit lab(kDense);
  const pipeline::Curve& truth = lab.truth();
  pipeline::MmeTest test;
  test.channels = {{"11HEAD0000H3ANYP", "", "deg", 0.02, 5e-4, truth.values}};
  write_mme_test(lab.path("lab12/lab12.mme"), test);
  const std::string target = "table = \"lab12\"\ntime_zero = \"20 ms\"\n" + kDegree;
  CHECK(lab.damping(target) == Approx(kDamping).epsilon(1e-4));
  // The fit rests on the channel's file, not on the folder.
  CHECK_THAT(bytes_of(lab.path("out/fitted.toml")), Contains("lab12.001"));
  // A filter changes so slow a motion only a little; it must have been applied, and the fit reports
  // where it cannot be.
  const double filtered = lab.damping(target + "filter = \"CFC 60\"\n");
  CHECK(filtered == Approx(kDamping).epsilon(0.01));
  CHECK(filtered != Approx(kDamping).epsilon(1e-6));
  lab.file("uneven.csv") << "time [ms],phi [deg]\n0,1\n2,2\n9,3\n";
  lab.refuses("table = \"uneven.csv\"\nfilter = \"CFC 60\"\n" + kDegree, "equal intervals");
}

TEST_CASE("a curve's rating is a target, and leads to the curve") {
  const CurveFit lab(kDense);
  const pipeline::Curve& truth = lab.truth();
  std::ofstream late = lab.file("late.csv");  // shifted by 10 ms, in other units
  late << "time [ms],phi [rad]\n";
  for (Eigen::Index k = 0; k < truth.values.size(); ++k)
    late << 1e3 * truth.time_s[k] + 10 << "," << truth.values[k] * std::acos(-1.0) / 180 << "\n";
  late.close();
  for (const char* const kind : {"iso18571", "cora"}) {
    INFO(kind);
    const std::string target = "table = \"late.csv\"\ntime_zero = \"10 ms\"\nrating = \"" +
                               std::string(kind) +
                               "\"\nvalue = \"1\"\nstandard_deviation = \"0.01\"\n";
    CHECK(lab.damping(target, "profiles = false\n") == Approx(kDamping).epsilon(0.02));
    CHECK(cell(table_in(lab.path("out"), "fit targets"), 0, 2) > 0.99);
  }
  lab.refuses("table = \"late.csv\"\nrating = \"cora\"\n" + kDegree, "expected a value");
}

TEST_CASE("a corridor is a window at each of its points") {
  const CurveFit lab;
  const pipeline::Curve& truth = lab.truth();
  std::ofstream band = lab.file("band.csv");
  band << "time [ms],lower [deg],upper [deg]\n";
  for (Eigen::Index k = 0; k < truth.values.size(); ++k)
    band << 1e3 * truth.time_s[k] << "," << truth.values[k] - 0.2 << "," << truth.values[k] + 0.2
         << "\n";
  band.close();
  const std::string section = "history_samples = 200\nprofiles = false\n";
  const std::string corridor = "points = 100\n[fit.target.corridor]\ntable = \"band.csv\"\n";
  CHECK(lab.damping(corridor, section) == Approx(kDamping).epsilon(0.05));
  CHECK(cell(table_in(lab.path("out"), "fit targets"), 0, 5) < 0.05);  // of 0.04 deg
  const nlohmann::json history = table_in(lab.path("out"), "fit history");
  CHECK_THAT(bytes_of(lab.path("out/fit-curve-rotation.svg")), Contains("corridor"));
  // If the window is kept, a fit to a much smaller peak ends where the run is at its edge.
  const std::string smaller =
      "[[fit.target]]\nname = \"peak\"\noutput = \"pendulum.flexion.head_rotation\"\n"
      "value = \"1 deg\"\nstandard_deviation = \"1 deg\"\n";
  const double edge = lab.damping("must_hold = true\n" + corridor + smaller, "profiles = false\n");
  CHECK(table_in(lab.path("out"), "fit targets").at("rows").at(0).at(6) == "inside");
  CHECK(edge > kDamping);
  const pipeline::Curve at_edge = lab.run_with(edge);
  CHECK((at_edge.values - truth.values).cwiseAbs().maxCoeff() == Approx(0.2).epsilon(0.02));
  // Only a part of the prior is inside, whereas averaging over the time at rest would accept all of
  // it.
  CHECK(cell(history, 1, 3) < 50);
  CHECK(cell(history, 1, 3) > 0);

  lab.refuses(
      "[fit.target.corridor]\ntimes = [\"0 ms\", \"9 ms\"]\nlower = [0, 2]\nupper = [1, 1]\n"
      "unit = \"deg\"\n",
      "crosses itself");
  lab.refuses(kTable + corridor, "has no effect beside a corridor");
  lab.refuses(kDegree + corridor, "has no effect on a corridor");
  lab.refuses("to = \"900 ms\"\n" + corridor, "within those of the corridor");
  lab.refuses(
      "[fit.target.corridor]\ntimes = [\"0 ms\", \"9 ms\"]\nlower = [0, 1]\nupper = [1, 1]\n"
      "unit = \"deg\"\n",
      "no width");
  lab.refuses(
      "[fit.target.corridor]\ntimes = [\"0 ms\", \"9 ms\"]\nlower = [0, 1]\nupper = [1, 3]\n"
      "unit = \"N\"\n",
      "rad");
}

TEST_CASE("of a corridor one point outside is enough, however small the mean") {
  const std::vector<pipeline::FitTerm> terms(
      10, {"band", 0, 0.1, pipeline::FitTerm::Window{-1, 1}, false});
  const std::vector<pipeline::FitRange> ranges = {{"x", 0, 1, {}}};
  const pipeline::FitObjective objective(ranges, terms, {});
  Eigen::VectorXd values = Eigen::VectorXd::Zero(10);
  CHECK(met_targets(objective, values, 3) == std::vector<bool>{true});
  values[4] = 1.01;
  CHECK(met_targets(objective, values, 3) == std::vector<bool>{false});
}
