// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "pipeline/parameter_studies/evaluation/figures.h"

using namespace flexneck;
using namespace flexneck::pipeline;

TEST_CASE("a figure of small motions that meet a kink has no value, and says why") {
  multibody::SystemMode mode;
  mode.frequency_Hz = 5;
  mode.damping_ratio = 0.2;
  CHECK(system_figure(mode, "system_frequency").value == 5);
  CHECK(system_figure(mode, "system_damping_ratio").value == 0.2);
  mode.kink = "section 'disc': a gap opens or closes";
  for (const char* const name : {"system_frequency", "system_damping_ratio"}) {
    const ResultValue figure = system_figure(mode, name);
    CHECK_FALSE(figure.value);
    CHECK_THAT(figure.problem, Catch::Matchers::Contains("section 'disc'"));
  }
}
