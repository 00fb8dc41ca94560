// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <string>

#include <catch2/catch.hpp>

#include "tests/support/model_reading.h"

namespace flexneck::pipeline {

TEST_CASE("a follower force on a body that spins evenly: closed form, both formulations") {
  const TemporaryFolder folder;
  for (const std::string formulation : {"recursive", "descriptor"}) {
    const ModelFile file = testing::read_model(
        folder, "[solver]\nend_time = \"1 s\"\nformulation = \"" + formulation + R"("
relative_tolerance = 1e-11
absolute_tolerance = 1e-13
[output]
interval = "0.1 s"
[[body]]
name = "puck"
kind = "rigid"
mass = "2 kg"
center = ["0 m", "0 m", "0 m"]
inertia = ["0.1 kg*m^2", "0.1 kg*m^2", "0.2 kg*m^2"]
position = ["0 m", "0 m", "0 m"]
angular_velocity = ["0 rad/s", "0 rad/s", "5 rad/s"]
[[marker]]
body = "puck"
name = "middle"
position = ["0 m", "0 m", "0 m"]
rotation = ["0 rad", "0 rad", "0.5 rad"]
[[force]]
name = "jet"
marker = "puck.middle"
direction = [1, 0, 0]
magnitude = "3 N"
follows = true
[[torque]]
name = "still"
marker = "puck.middle"
direction = [0, 0, 1]
magnitude = "0 N*m"
follows = true
)");
    const multibody::History found = testing::run(file);
    const auto& puck = found.marker("puck.middle");
    // v = F / (m w) (sin(w t + p) - sin p, cos p - cos(w t + p)), marker's angle p at the start
    const double speed = 3. / 2 / 5, p = 0.5;
    for (Eigen::Index k = 0; k < found.time_s.size(); ++k) {
      const double turned = 5 * found.time_s[k] + p;
      CHECK(puck.velocity_m_s(0, k) ==
            Approx(speed * (std::sin(turned) - std::sin(p))).margin(1e-9));
      CHECK(puck.velocity_m_s(1, k) ==
            Approx(speed * (std::cos(p) - std::cos(turned))).margin(1e-9));
    }
    CHECK(found.energy.work_J.tail<1>()[0] ==
          Approx(found.energy.kinetic_J.tail<1>()[0] - found.energy.kinetic_J[0]).margin(1e-9));
  }
}

}  // namespace flexneck::pipeline
