// SPDX-License-Identifier: GPL-3.0-or-later
// Derivatives of the modes' results in closed form, against differences of solutions.
#include <cmath>
#include <fstream>

#include <catch2/catch.hpp>

#include "geometry/foundation/error.h"
#include "geometry/foundation/temporary_folder.h"
#include "pipeline/parameter_studies/evaluation/evaluator.h"
#include "tests/pipeline/parameter_studies/fit/fit_runs.h"

using namespace flexneck;
using namespace flexneck::pipeline;

namespace {

/// Writes a study of the neck with a coarse mesh, with the rubber's modulus and density on one
/// variable.
std::filesystem::path write_neck(const std::filesystem::path& folder) {
  std::filesystem::path path = folder / "neck.toml";
  std::ofstream(path) << "include = [\"" FLEXNECK_SOURCE_DIR
                         "/pipeline/data/studies/hybrid3_a.toml\"]\n"
                         "[variables]\nstiff = 1\n"
                         "[mesh]\nquadrant = 2\ninner_ring = 2\nrubber_layers = 1\n"
                         "[geometry.materials.butyl]\nyoungs_modulus = \"$stiff*1.2 kpsi\"\n"
                         "density = \"$stiff*0.0343 lb/in^3\"\n";
  return path;
}

}  // namespace

TEST_CASE("slopes of modes' figures in closed form are those of solutions apart") {
  const TemporaryFolder folder;
  Evaluator evaluator({write_neck(folder.path()), {}}, testing::quiet_console());
  const WantedOutputs wanted = evaluator.wanted(
      {"modes.mass", "modes.frequency_by_rank.bending 1", "modes.frequency_by_rank.bending 2",
       "modes.frequency_by_rank.bending 4", "modes.frequency_by_rank.torsion 1",
       "modes.frequency.axial 1", "modes.system_frequency", "modes.static_stiffness.My/ry at top",
       "modes.static_stiffness.Fz/uz at top"},
      {});
  const auto at = [](double thickness_in, double stiff) -> std::vector<std::string> {
    return {"geometry.top_plate_thickness=\"" + std::to_string(thickness_in) + " in\"",
            "variables.stiff=" + std::to_string(stiff)};
  };
  const std::vector<std::string> middle = at(1.1, 1.2);
  REQUIRE(evaluator.has_slopes(middle, {at(1.2, 1.2), at(1.1, 1.21)}, wanted));
  CHECK_FALSE(evaluator.has_slopes(middle, {{"body.head.mass=\"2 kg\""}}, wanted));
  const FigureSlopes slopes =
      evaluator.slopes(middle, {{at(1.101, 1.2), 1e-3}, {at(1.1, 1.2001), 1e-4}}, wanted);
  CHECK((slopes.values - evaluator.evaluate(middle, wanted).figures).norm() <
        1e-9 * slopes.values.norm());
  const auto difference = [&](const std::vector<std::string>& below,
                              const std::vector<std::string>& above, double width) {
    return Eigen::VectorXd(
        (evaluator.evaluate(above, wanted).figures - evaluator.evaluate(below, wanted).figures) /
        width);
  };
  const Eigen::VectorXd by_thickness = difference(at(1.09, 1.2), at(1.11, 1.2), 0.02);
  const Eigen::VectorXd by_stiff = difference(at(1.1, 1.19), at(1.1, 1.21), 0.02);
  for (Eigen::Index k = 0; k < by_thickness.size(); ++k) {
    INFO(wanted.figures[static_cast<std::size_t>(k)].text);
    CHECK(slopes.derivatives(k, 0) == Approx(by_thickness[k]).epsilon(1e-3).margin(1e-9));
    CHECK(slopes.derivatives(k, 1) ==
          Approx(by_stiff[k]).epsilon(1e-3).margin(1e-6 * slopes.values[k]));
  }
  // Another number of elements is another topology.
  CHECK_THROWS_AS(evaluator.slopes(middle, {{{"mesh.plate_layers=2"}, 1}}, wanted), InputError);
}

TEST_CASE("the static stiffness of a bar along its axis is E A / L") {
  const TemporaryFolder folder;
  Evaluator evaluator({testing::write_beam_study(folder.path()), {}}, testing::quiet_console());
  const auto stiffness = [&](const std::string& name) {
    return evaluator.evaluate({}, evaluator.wanted({"modes.static_stiffness." + name}, {}))
        .figures[0];
  };
  // 70 MPa, 32 mm by 30 mm, 144 mm; the clamp also constrains the width.
  CHECK(stiffness("Fz/uz at top") == Approx(70e6 * 0.032 * 0.030 / 0.144).epsilon(0.03));
  const auto refused = [&](const std::string& name, const std::string& why) {
    CHECK_THROWS_WITH(stiffness(name), Catch::Matchers::Contains(why));
  };
  refused("Fz/uy at top", "did you mean 'F");
  refused("My/ry", "at <interface>");
  CHECK_THROWS_AS(stiffness("My/ry at middle"), InputError);
  refused("My/ry at base", "has no static stiffness");
}
