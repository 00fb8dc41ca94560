// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "pipeline/experiments/pendulum.h"
#include "tests/support/beam_experiment.h"

using namespace flexneck;
using namespace flexneck::pipeline;
using Experiment = testing::BeamExperiment;

TEST_CASE(
    "an oblique run at the ends of its quarter is that in the plane, and its mirror image "
    "mirrors") {
  const auto run = [](const std::string& name, std::vector<std::string> settings) {
    settings.push_back("case." + name + ".duration=0.1 s");
    settings.push_back("variant.equivalent.of=['extension-60']");  // it has one axis
    const Experiment experiment(settings);
    return run_pendulum(experiment.study, experiment.named(name), experiment.body).channels;
  };
  const auto oblique = [&](const std::string& name, const std::string& angle) {
    return run(name,
               {"case." + name + ".direction=oblique", "case." + name + ".oblique_angle=" + angle});
  };
  const auto compare = [](const auto& found, const auto& expected) {
    REQUIRE(found.size() == expected.size());
    for (std::size_t k = 0; k < found.size(); ++k) {
      CAPTURE(found[k].name);
      CHECK((found[k].values - expected[k].values).norm() <
            1e-6 * expected[k].values.norm() + 1e-9);
    }
  };
  compare(oblique("flexion-60", "0 deg"), run("flexion-60", {}));
  compare(oblique("lateral-65", "90 deg"), run("lateral-65", {}));
  compare(oblique("flexion-60", "-45 deg"), oblique("flexion-60", "45 deg"));
  CHECK_THROWS_WITH(run("flexion-60", {"case.flexion-60.oblique_angle=10 deg"}),
                    Catch::Matchers::Contains("it belongs to direction = \"oblique\""));
  CHECK_THROWS_WITH(run("flexion-60", {"case.flexion-60.direction=oblique"}),
                    Catch::Matchers::Contains("oblique_angle"));
}
