// SPDX-License-Identifier: GPL-3.0-or-later
// Pulses of random shape, time and number in runs of random length, as the translation of a body,
// as its rotation or that of a joint, and as a force: the resulting velocity, against its closed
// form.
#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>
#include <vector>

#include <fmt/core.h>

#include "geometry/foundation/error.h"
#include "multibody/simulation/simulation.h"
#include "pipeline/language/model/model_file.h"
#include "tests/campaigns/campaign.h"
#include "tests/campaigns/draws.h"

namespace {

using flexneck::campaigns::Case;
using flexneck::campaigns::log_between;
using std::numbers::pi;

/// A pulse shape over x from 0 to 1: an expression, and its integral from 0.
struct Shape {
  const char* text;
  double (*integral)(double x);
};

constexpr std::array<Shape, 5> kShapes = {{
    {"sin(pi*{0})", [](double x) { return (1 - std::cos(pi * x)) / pi; }},
    {"1", [](double x) { return x; }},
    {"(1-abs(2*{0}-1))", [](double x) { return x < 0.5 ? x * x : 0.5 - (1 - x) * (1 - x); }},
    {"(1-cos(2*pi*{0}))/2", [](double x) { return x / 2 - std::sin(2 * pi * x) / (4 * pi); }},
    {"{0}", [](double x) { return x * x / 2; }},
}};
/// Index of the shape that is smooth enough for a displacement: a bump.
constexpr std::size_t kBump = 3;

struct Pulse {
  const Shape* shape;
  double begin_s, length_s, size;

  std::string x() const { return fmt::format("((t-{:.17g})/{:.17g})", begin_s, length_s); }
  std::string text() const {
    return fmt::format("{:.17g}*{}*(t>{:.17g} && t<{:.17g})", size,
                       fmt::format(fmt::runtime(shape->text), x()), begin_s, begin_s + length_s);
  }
  double share(double t) const { return std::clamp((t - begin_s) / length_s, 0., 1.); }
  double integral(double t) const { return size * length_s * shape->integral(share(t)); }
  /// Velocity of the pulse as a displacement, with the shape kBump.
  double rate(double t) const { return size * pi / length_s * std::sin(2 * pi * share(t)); }
};

enum class Drive { travel, displacement, turn, motor, force };

struct Drawn {
  Drive drive;
  std::vector<Pulse> pulses;
  double end_s, interval_s;
  bool is_implicit;

  double velocity(double t) const {
    double sum = 0;
    for (const Pulse& pulse : pulses)
      sum += drive == Drive::displacement ? pulse.rate(t) : pulse.integral(t);
    return sum;
  }
  std::string expression() const {
    std::string text;
    for (const Pulse& pulse : pulses) text += (text.empty() ? "" : " + ") + pulse.text();
    return text;
  }
};

Drawn draw(Case& drawn) {
  constexpr double kResolution_s = 1e-4;
  Drawn of{static_cast<Drive>(drawn.whole(0, 4)), {}, 0, 0, drawn.chance(0.5)};
  of.end_s = log_between(drawn, 0.1, drawn.chance(0.1) ? 600 : 60);
  if (drawn.chance(0.3)) of.end_s = std::ceil(of.end_s);
  of.interval_s = of.end_s / drawn.whole(1, 200);
  const int count = drawn.whole(1, 3);
  for (int k = 0; k < count; ++k) {
    Pulse pulse;
    pulse.shape = of.drive == Drive::displacement
                      ? &kShapes[kBump]
                      : &kShapes[static_cast<std::size_t>(drawn.whole(0, 4))];
    pulse.length_s = log_between(drawn, kResolution_s, std::min(0.2, of.end_s / 2));
    pulse.begin_s = drawn.between(0, of.end_s - pulse.length_s);
    if (drawn.chance(0.3)) {  // as people write them
      pulse.length_s = std::ceil(pulse.length_s * 1e4) / 1e4;
      pulse.begin_s = std::floor(pulse.begin_s * 1e3) / 1e3;
    }
    pulse.size = (drawn.chance(0.5) ? 1 : -1) * log_between(drawn, 10, 1000);
    if (of.drive == Drive::displacement) pulse.size *= 0.1 * pulse.length_s * pulse.length_s;
    of.pulses.push_back(pulse);
  }
  return of;
}

/// Model text: a block on a sled, connected by a joint along x or about z, and a force that pushes
/// it.
std::string model_text(const Drawn& of) {
  const std::string expression = of.expression();
  const bool is_turn = of.drive == Drive::turn;
  std::string sled = "kind = \"ground\"\n";
  std::string rest;
  switch (of.drive) {
    case Drive::travel:
      sled = fmt::format("kind = \"prescribed\"\nacceleration = \"{}\"\n", expression);
      break;
    case Drive::displacement:
      sled = fmt::format("kind = \"prescribed\"\ndisplacement = \"{}\"\n", expression);
      break;
    case Drive::turn:
      sled = fmt::format(
          "kind = \"prescribed\"\n[body.turn]\naxis = [0, 0, 1]\nacceleration = \"{}\"\n",
          expression);
      break;
    case Drive::motor:
      rest = fmt::format(
          "[[motor]]\nname = \"m\"\njoint = \"j\"\ncoordinate = \"distance\"\nacceleration = "
          "\"{}\"\n",
          expression);
      break;
    case Drive::force:
      rest = fmt::format(
          "[[function_force]]\nname = \"f\"\nlower = \"sled.o\"\nupper = \"block.o\"\nFx = "
          "\"{}\"\n",
          expression);
      break;
  }
  return fmt::format(
      "[solver]\nend_time = \"{:.17g} s\"\nintegrator = \"{}\"\n[output]\ninterval = \"{:.17g} "
      "s\"\n"
      "[[body]]\nname = \"sled\"\n{}"
      "[[body]]\nname = \"block\"\nkind = \"rigid\"\nmass = \"1 kg\"\n"
      "center = [\"0 m\", \"0 m\", \"0 m\"]\n"
      "inertia = [\"1 kg*m^2\", \"1 kg*m^2\", \"1 kg*m^2\"]\n"
      "[[marker]]\nbody = \"sled\"\nname = \"o\"\nposition = [\"0 m\", \"0 m\", \"0 m\"]\n"
      "[[marker]]\nbody = \"block\"\nname = \"o\"\nposition = [\"0 m\", \"0 m\", \"0 m\"]\n"
      "[[joint]]\nname = \"j\"\nkind = \"{}\"\nlower = \"sled.o\"\nupper = \"block.o\"\n"
      "axis = [{}]\n{}",
      of.end_s, of.is_implicit ? "generalised_alpha" : "dormand_prince", of.interval_s, sled,
      is_turn ? "revolute" : "prismatic", is_turn ? "0, 0, 1" : "1, 0, 0", rest);
}

/// Ratio of sizes above which a smaller bump may be refused: a displacement is known to 1e-12 of
/// its largest value, its velocity over a short bump less accurately.
constexpr double kBesideLarger = 1e4;

/// Refusals that are right: such bumps, and an impact that the implicit method does not resolve, as
/// the energy balance shows.
bool is_refused_rightly(const Drawn& of, const std::string& text) {
  if (of.is_implicit && text.find("energy balance") != std::string::npos) return true;
  if (of.drive != Drive::displacement) return false;
  const auto [least, largest] = std::minmax_element(
      of.pulses.begin(), of.pulses.end(),
      [](const Pulse& a, const Pulse& b) { return std::abs(a.size) < std::abs(b.size); });
  return std::abs(largest->size) > kBesideLarger * std::abs(least->size);
}

std::optional<std::string> compare(const Drawn& of, const std::string& file) {
  const flexneck::pipeline::ModelFile model = flexneck::pipeline::read_model_file({file}, {});
  const flexneck::multibody::History history = flexneck::multibody::simulate(
      model.model, model.solver, {.end_time_s = of.end_s, .interval_s = of.interval_s});
  const auto& sled = history.marker("sled.o");
  const auto& block = history.marker("block.o");
  const bool block_is_free = of.drive != Drive::motor && of.drive != Drive::force;
  double of_sled = 0, of_block = 0, size = 0;
  for (Eigen::Index k = 0; k < history.time_s.size(); ++k) {
    const double v = of.velocity(history.time_s[k]);
    const auto component = [&](const flexneck::multibody::MarkerHistory& marker) {
      return of.drive == Drive::turn ? marker.angular_velocity_rad_s(2, k)
                                     : marker.velocity_m_s(0, k);
    };
    of_sled = std::max(of_sled, std::abs(component(sled) - (block_is_free ? v : 0)));
    of_block = std::max(of_block, std::abs(component(block) - (block_is_free ? 0 : v)));
  }
  for (const Pulse& pulse : of.pulses)
    size +=
        std::abs(of.drive == Drive::displacement ? pulse.rate(pulse.begin_s + pulse.length_s / 4)
                                                 : pulse.integral(of.end_s));
  // A prescribed motion is exact; the block's motion is accurate to the run's tolerance.
  const double of_run = of.is_implicit ? 2e-2 : 1e-3;
  if (of_sled <= 1e-7 * size && of_block <= of_run * size) {
    std::filesystem::remove(file);
    return {};
  }
  // A run that says itself that it went wrong is not wrong without a word.
  if (!history.warnings.empty()) throw flexneck::ComputationError(history.warnings.front());
  return fmt::format(
      "{}: drive {}, {} over {:.6g} s: the sled is off by {:.2e}, the block by {:.2e} "
      "of {:.3g}",
      file, static_cast<int>(of.drive), of.is_implicit ? "generalised-alpha" : "Dormand-Prince",
      of.end_s, of_sled, of_block, size);
}

std::optional<std::string> judge(Case& drawn) {
  const Drawn of = draw(drawn);
  const std::string file = fmt::format("{}/{}.toml", drawn.folder, drawn.number);
  std::ofstream(file) << model_text(of);
  try {
    return compare(of, file);
  } catch (const std::runtime_error& error) {
    if (!is_refused_rightly(of, error.what())) throw;
    drawn.was_refused = true;
    return {};
  }
}

}  // namespace

int main(int argc, char** argv) { return flexneck::campaigns::run(argc, argv, judge); }
