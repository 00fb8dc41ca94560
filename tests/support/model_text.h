// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <fstream>
#include <string>

namespace flexneck::testing {

/// A physical pendulum of two bodies, each rotating about its own axis: small, and not planar.
inline std::string double_pendulum_text() {
  return R"(
[solver]
end_time = "0.2 s"
relative_tolerance = 1e-10
absolute_tolerance = 1e-12
gravity = ["0 gn", "0 gn", "-1 gn"]

[output]
interval = "1 ms"

[[body]]
name = "ground"
kind = "ground"

[[body]]
name = "upper"
kind = "rigid"
mass = "2 kg"
center = ["0 m", "0 m", "-0.2 m"]
inertia = ["0.03 kg*m^2", "0.03 kg*m^2", "0.01 kg*m^2"]

[[body]]
name = "lower"
kind = "rigid"
mass = "1 kg"
center = ["0.05 m", "0 m", "-0.1 m"]
inertia = ["0.004 kg*m^2", "0.004 kg*m^2", "0.001 kg*m^2"]

[[marker]]
body = "ground"
name = "hook"
position = ["0 m", "0 m", "1 m"]

[[marker]]
body = "upper"
name = "top"
position = ["0 m", "0 m", "0 m"]

[[marker]]
body = "upper"
name = "end"
position = ["0 m", "0 m", "-0.4 m"]
rotation = ["0 deg", "0 deg", "30 deg"]

[[marker]]
body = "lower"
name = "top"
position = ["0 m", "0 m", "0 m"]
rotation = ["0 deg", "0 deg", "30 deg"]

[[marker]]
body = "lower"
name = "tip"
position = ["0 m", "0.03 m", "-0.2 m"]

[[joint]]
name = "shoulder"
kind = "pin"
lower = "ground.hook"
upper = "upper.top"
axis = [0, 1, 0]
angle = "40 deg"
rate = "300 deg/s"

[[joint]]
name = "elbow"
kind = "pin"
lower = "upper.end"
upper = "lower.top"
axis = [1, 0, 0]
angle = "-70 deg"
rate = "8 rad/s"
)";
}

/// A marker at the origin of its body.
inline std::string origin_marker_text(const std::string& body, const std::string& name) {
  return "\n[[marker]]\nbody = \"" + body + "\"\nname = \"" + name +
         "\"\nposition = [\"0 m\", \"0 m\", \"0 m\"]\n";
}

/// A box of 1 kg with a marker at its centre.
inline std::string box_text(const std::string& name, const std::string& marker) {
  return "\n[[body]]\nname = \"" + name + R"("
kind = "rigid"
mass = "1 kg"
center = ["0 m", "0 m", "0 m"]
inertia = ["1 kg*m^2", "1 kg*m^2", "1 kg*m^2"]
)" + origin_marker_text(name, marker);
}

/// A neck with the modes of "neck.h5" and a head.
inline std::string neck_and_head_text() {
  return R"(
[[body]]
name = "neck"
kind = "deformable"
modes_file = "neck.h5"
damping_ratio = 0.1
[[body]]
name = "head"
kind = "rigid"
mass = "4.5 kg"
center = ["0.02 m", "0.01 m", "0.05 m"]
inertia = ["0.02 kg*m^2", "0.02 kg*m^2", "0.015 kg*m^2"]
)";
}

inline std::string fixed_joint_text(const std::string& name, const std::string& lower,
                                    const std::string& upper) {
  return "\n[[joint]]\nname = \"" + name + "\"\nkind = \"fixed\"\nlower = \"" + lower +
         "\"\nupper = \"" + upper + "\"\n";
}

inline std::filesystem::path write_test_file(const std::filesystem::path& path,
                                             const std::string& text) {
  std::ofstream(path) << text;
  return path;
}

/// The text with one part replaced; the part must be there.
inline std::string with(std::string text, const std::string& part, const std::string& by) {
  return text.replace(text.find(part), part.size(), by);
}

}  // namespace flexneck::testing
