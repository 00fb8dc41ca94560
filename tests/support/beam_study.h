// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <fstream>
#include <string>

namespace flexneck::testing {

/// Writes a study that takes milliseconds: a bar of eight elements in place of the neck, with a
/// head on top, in a pendulum for a quarter of a second ("flexion", and "far" with a stronger
/// pulse) and in the static tester ("pull"). beam.inp lies beside it.
/// @param more  text at the end of the file
/// @return path of the study
inline std::filesystem::path write_beam_study(const std::filesystem::path& folder,
                                              const std::string& more = "") {
  constexpr int kElements = 8;
  std::ofstream deck(folder / "beam.inp");
  deck << "*Node\n";
  for (int layer = 0; layer <= kElements; ++layer)
    for (int corner = 0; corner < 4; ++corner)
      deck << 4 * layer + corner + 1 << ", " << (corner == 1 || corner == 2 ? 16 : -16) << ", "
           << (corner > 1 ? 15 : -15) << ", " << 144.0 * layer / kElements << "\n";
  deck << "*Element, type=C3D8, elset=BAR\n";
  for (int k = 0; k < kElements; ++k) {
    deck << k + 1;
    for (int node = 1; node <= 8; ++node) deck << ", " << 4 * k + node;
    deck << "\n";
  }
  deck << "*Nset, nset=Clamp\n1, 2, 3, 4\n*Surface, name=Tip, type=ELEMENT\n"
       << kElements << ", S2\n*Material, name=Rubber\n*Elastic\n70., 0.3\n*Density\n3e-9\n"
       << "*Solid Section, elset=BAR, material=Rubber\n";
  const std::filesystem::path path = folder / "study.toml";
  std::ofstream(path) << R"([geometry]
file = "beam.inp"
unit = "mm"
[modes]
count = 4
fixed = ["Clamp"]
rigid_parts = ["BAR"]
attached_body = "head"
[[interface]]
name = "base"
set = "Clamp"
position = ["0 mm", "0 mm", "0 mm"]
[[interface]]
name = "top"
set = "Tip"
position = ["0 mm", "0 mm", "144 mm"]
[output]
interval = "2.5 ms"
[solver]
relative_tolerance = 1e-6
[[body]]
name = "ground"
kind = "ground"
[[body]]
name = "arm"
kind = "prescribed"
[[body]]
name = "neck"
kind = "deformable"
modes = ["all"]
damping_ratio = 0.9
[[body]]
name = "head"
kind = "rigid"
mass = "4.5 kg"
center = ["0 m", "0 m", "0.05 m"]
inertia = ["0.017 kg*m^2", "0.024 kg*m^2", "0.021 kg*m^2", "0 kg*m^2", "0 kg*m^2", "0 kg*m^2"]
[[marker]]
body = "ground"
name = "bench"
position = ["0 m", "0 m", "0 m"]
[[marker]]
body = "arm"
name = "end"
position = ["0 m", "0 m", "0 m"]
[[marker]]
body = "head"
name = "condyles"
position = ["0 m", "0 m", "0 m"]
[[marker]]
body = "head"
name = "cg"
position = ["0 m", "0 m", "0.05 m"]
[[joint]]
name = "clamp"
kind = "fixed"
lower = "ground.bench"
upper = "neck.base"
[[joint]]
name = "j1"
kind = "fixed"
lower = "arm.end"
upper = "neck.base"
[[joint]]
name = "j2"
kind = "fixed"
lower = "neck.top"
upper = "head.condyles"
[[force]]
name = "load"
marker = "neck.top"
direction = [1, 0, 0]
times = ["0 s", "1 s"]
magnitudes = ["0 N", "100 N"]
[[pulse]]
name = "short"
times = ["0 ms", "4 ms", "30 ms", "42 ms"]
deceleration = ["0 gn", "24 gn", "15 gn", "0 gn"]
[[pulse]]
name = "long"
times = ["0 ms", "10 ms", "60 ms", "80 ms"]
deceleration = ["0 gn", "24 gn", "15 gn", "0 gn"]
[pendulum]
bodies = ["arm", "neck", "head"]
direction = "flexion"
duration = "0.25 s"
[[case]]
name = "flexion"
kind = "pendulum"
pulse = "short"
impact_velocity = "2 m/s"
[[case]]
name = "far"
kind = "pendulum"
pulse = "long"
impact_velocity = "3 m/s"
[[case]]
name = "pull"
kind = "static"
bodies = ["ground", "neck"]
direction = "flexion"
forces = ["load"]
duration = "1 s"
[dummy]
name = "Hybrid III 50th male"
[[test]]
name = "certified"
regulation = "572.33 flexion"
case = "far"
)" << more;
  return path;
}

}  // namespace flexneck::testing
