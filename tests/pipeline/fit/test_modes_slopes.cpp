// SPDX-License-Identifier: GPL-3.0-or-later
// Derivatives of modes' figures in closed form against differences of solutions.
#include <cmath>
#include <fstream>

#include <catch2/catch.hpp>

#include "geometry/foundation/error.h"
#include "geometry/foundation/temporary_folder.h"
#include "pipeline/evaluation/evaluator.h"

using namespace flexneck;
using namespace flexneck::pipeline;

namespace {

/// A clamped bar whose length and modulus hang on one variable besides its length alone, with a
/// weight at its end.
std::filesystem::path write_bar(const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / "bar.toml";
  std::ofstream(path) << "include = [\"" FLEXNECK_SOURCE_DIR
                         "/geometry/examples/cantilever.toml\"]\n"
                         "[variables]\nstiff = 1\n"
                         "[geometry]\nconstants = { length = \"500 mm\", along = 5 }\n"
                         "[geometry.materials.aluminium]\nyoungs_modulus = \"$stiff*70 GPa\"\n"
                         "density = \"$stiff*2700 kg/m^3\"\n"
                         "[modes]\nrigid_parts = [\"bar\"]\nattached_body = \"weight\"\n"
                         "[[interface]]\nname = \"tip\"\nset = \"tip\"\n"
                         "[[body]]\nname = \"weight\"\nkind = \"rigid\"\nmass = \"1 kg\"\n"
                         "center = [\"0.5 m\", \"0 m\", \"0 m\"]\n"
                         "inertia = [\"1e-3 kg*m^2\", \"1e-3 kg*m^2\", \"1e-3 kg*m^2\", "
                         "\"0 kg*m^2\", \"0 kg*m^2\", \"0 kg*m^2\"]\n";
  return path;
}

}  // namespace

TEST_CASE("slopes of modes' figures in closed form are those of solutions apart") {
  const TemporaryFolder folder;
  const Console console(Verbosity::quiet);
  Evaluator evaluator({write_bar(folder.path()), {}}, console);
  const WantedOutputs wanted = evaluator.wanted(
      {"modes.mass", "modes.frequency_by_rank.bending 1", "modes.frequency_by_rank.bending 2",
       "modes.frequency_by_rank.torsion 1", "modes.system_frequency"},
      {});
  const auto at = [](double length_mm, double stiff) -> std::vector<std::string> {
    return {"geometry.constants.length=\"" + std::to_string(length_mm) + " mm\"",
            "variables.stiff=" + std::to_string(stiff)};
  };
  const std::vector<std::string> middle = at(480, 1.2);
  REQUIRE(evaluator.has_slopes(middle, {at(481, 1.2), at(480, 1.21)}, wanted));
  CHECK_FALSE(evaluator.has_slopes(middle, {{"body.weight.mass=\"2 kg\""}}, wanted));
  const FigureSlopes slopes =
      evaluator.slopes(middle, {{at(480.01, 1.2), 0.01}, {at(480, 1.2001), 1e-4}}, wanted);
  CHECK((slopes.values - evaluator.evaluate(middle, wanted).figures).norm() <
        1e-9 * slopes.values.norm());
  const auto difference = [&](const std::vector<std::string>& below,
                              const std::vector<std::string>& above, double width) {
    return Eigen::VectorXd(
        (evaluator.evaluate(above, wanted).figures - evaluator.evaluate(below, wanted).figures) /
        width);
  };
  const Eigen::VectorXd by_length = difference(at(479, 1.2), at(481, 1.2), 2);
  const Eigen::VectorXd by_stiff = difference(at(480, 1.19), at(480, 1.21), 0.02);
  for (Eigen::Index k = 0; k < by_length.size(); ++k) {
    INFO(wanted.figures[static_cast<std::size_t>(k)].text);
    CHECK(slopes.derivatives(k, 0) == Approx(by_length[k]).epsilon(1e-3).margin(1e-9));
    CHECK(slopes.derivatives(k, 1) ==
          Approx(by_stiff[k]).epsilon(1e-3).margin(1e-6 * slopes.values[k]));
  }
  // Another number of elements is another topology.
  CHECK_THROWS_AS(evaluator.slopes(middle, {{{"geometry.constants.along=6"}, 1}}, wanted),
                  InputError);
}
