// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <sstream>

#include <catch2/catch.hpp>

#include "geometry/foundation/error.h"
#include "geometry/neck/neck_drawing.h"
#include "geometry/neck/neck_measures.h"
#include "geometry/plausibility.h"
#include "tests/support/neck_parameters.h"

namespace flexneck::geometry {
namespace {

using Catch::Matchers::Contains;
using testing::kInch;
using testing::neck_parameters;

std::map<std::string, double> uniform_density(double density) {
  std::map<std::string, double> densities;
  for (const NeckLayer& layer : layers_of(neck_parameters("C"))) densities[layer.part] = density;
  return densities;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::ptrdiff_t count(const std::string& text, char c) {
  return std::count(text.begin(), text.end(), c);
}

}  // namespace

TEST_CASE("a neck of one material and one diameter is a tube") {
  NeckParameters neck = neck_parameters("A");
  for (double NeckParameters::*diameter :
       {&NeckParameters::centre_rubber_diameter, &NeckParameters::bottom_rubber_diameter,
        &NeckParameters::top_rubber_diameter}) {
    neck.*diameter = neck.plate_diameter;
  }
  neck.centre_rubber_offset = neck.bottom_rubber_offset = neck.top_rubber_offset = 0;
  const NeckMeasures tube = measure(neck, uniform_density(1000));
  const double outer = neck.plate_diameter / 2;
  const double inner = neck.hole_diameter / 2;
  const double h = neck.length;
  const double mass = 1000 * M_PI * (outer * outer - inner * inner) * h;
  const double squares = outer * outer + inner * inner;
  CHECK(tube.mass_kg == Approx(mass).epsilon(1e-12));
  CHECK(tube.volume_m3 == Approx(mass / 1000).epsilon(1e-12));
  CHECK(std::abs(tube.centre_m[0]) < 1e-15);
  CHECK(tube.centre_m[2] == Approx(h / 2).epsilon(1e-12));
  CHECK(tube.inertia_kg_m2[0] == Approx(mass * (3 * squares + h * h) / 12).epsilon(1e-12));
  CHECK(tube.inertia_kg_m2[1] == Approx(mass * (3 * squares + h * h) / 12).epsilon(1e-12));
  CHECK(tube.inertia_kg_m2[2] == Approx(mass * squares / 2).epsilon(1e-12));
  CHECK(std::abs(tube.product_xz_kg_m2) < 1e-15);
}

TEST_CASE("a part without density is refused by name") {
  auto densities = uniform_density(1);
  densities.erase("rubber_3");
  CHECK_THROWS_WITH(measure(neck_parameters("C"), densities),
                    Contains("part 'rubber_3' has no material"));
}

TEST_CASE("the drawn section is to scale, within 80 columns, front to the right") {
  for (const char* set : {"A", "B", "C", "C'"}) {
    INFO("set " << set);
    const NeckParameters neck = neck_parameters(set);
    const std::vector<std::string> lines = lines_of(drawn_section(neck, {}));
    for (const std::string& line : lines) CHECK(line.size() <= 80);
    // A plate without its hole, in columns; a row is two columns high.
    const double plate = static_cast<double>(count(lines.front(), '#'));
    const double columns_per_m = plate / (neck.plate_diameter - neck.hole_diameter);
    CHECK(static_cast<double>(lines.size() - 1) ==
          Approx(neck.length * columns_per_m / 2).margin(1));
    for (const NeckLayer& layer : layers_of(neck)) {
      const auto labelled = std::find_if(lines.begin(), lines.end(), [&](const std::string& line) {
        return line.find(" " + layer.part + " ") != std::string::npos;
      });
      REQUIRE(labelled != lines.end());
      const double drawn = static_cast<double>(count(*labelled, layer.is_rubber ? ':' : '#'));
      CHECK(drawn == Approx((layer.diameter_m - neck.hole_diameter) * columns_per_m).margin(2));
    }
    CHECK_THAT(lines.back(), Contains("back") && Contains("front"));
    CHECK(lines.back().find("back") < lines.back().find("front"));
  }
}

TEST_CASE("slits are drawn in front of the hole, one line each, as long as they are deep") {
  const NeckParameters neck = neck_parameters("C");
  for (const double depth : {0.25, 0.75}) {
    for (const auto& [state, mark] : {std::pair(SlitState::open, '-'), {SlitState::closed, '='}}) {
      const std::vector<std::string> lines =
          lines_of(drawn_section(neck, {.state = state, .depth = depth}));
      int slits = 0;
      for (const std::string& line : lines) {
        if (count(line, mark) == 0) continue;
        ++slits;
        // The whole ligament is 1.55 - 0.3125 in wide, a column 3.4 in / 44.
        CHECK(static_cast<double>(count(line, mark)) ==
              Approx(depth * (1.55 - 0.3125) * 44 / 3.4).margin(1));
        CHECK(line.find(mark) > line.rfind(':', line.find(mark)));
        CHECK_THAT(line, Contains("rubber_2") || Contains("rubber_3"));
      }
      CHECK(slits == 2);
    }
  }
  CHECK(count(drawn_section(neck, {}), '-') == 0);
}

TEST_CASE("sizes and masses out of proportion are remarked upon") {
  CHECK(implausibilities(0.144, 1.24).empty());
  CHECK(implausibilities(5.0, 900).empty());
  // The neck in millimetres taken for metres, and the other way round.
  const auto giant = implausibilities(144, 1.24e9);
  REQUIRE(giant.size() == 2);
  CHECK_THAT(giant[0], Contains("extent is 144 m") && Contains("declared as metres"));
  CHECK_THAT(giant[1], Contains("mass is 1.24e+09 kg"));
  const auto dwarf = implausibilities(0.000144, 1.24e-9);
  REQUIRE(dwarf.size() == 2);
  CHECK_THAT(dwarf[0], Contains("declared as millimetres"));
  CHECK(implausibilities(std::nan(""), 1).size() == 1);
}

TEST_CASE("usual densities pass, and weight densities are remarked upon with what was meant") {
  struct Solid {
    double modulus_Pa, poissons_ratio, density_kg_m3;
  };
  // The neck's aluminium and butyl, steel, magnesium, tungsten, lead, polyamide, concrete, carbon
  // fibre composite, balsa across the grain, silicone, seat foam.
  const std::vector<Solid> usual = {
      {68.9e9, 0.33, 2715}, {8.27e6, 0.49, 949}, {210e9, 0.3, 7850}, {45e9, 0.29, 1740},
      {400e9, 0.28, 19300}, {16e9, 0.44, 11340}, {3e9, 0.39, 1140},  {30e9, 0.2, 2400},
      {135e9, 0.3, 1550},   {1.2e9, 0.3, 110},   {2e6, 0.495, 1100}, {1e5, 0.1, 40},
  };
  for (const Solid& solid : usual) {
    INFO(solid.density_kg_m3);
    CHECK(implausible_density(solid.modulus_Pa, solid.poissons_ratio, solid.density_kg_m3).empty());
  }
  const auto weighed = [](const Solid& solid, double factor) {
    return implausible_density(solid.modulus_Pa, solid.poissons_ratio,
                               factor * solid.density_kg_m3);
  };
  constexpr double kGravity = 9.80665;
  for (const Solid& solid : {usual[0], usual[1], usual[2], usual[3], usual[6], usual[7]}) {
    INFO(solid.density_kg_m3);
    CHECK_THAT(weighed(solid, kGravity), Contains("a weight density in N/m^3?"));
    CHECK_THAT(weighed(solid, kGravity / 0.0254), Contains("a weight density in lbf/in^3"));
    CHECK_THAT(weighed(solid, 1000), Contains("a density in kg/mm^3"));
    CHECK_THAT(weighed(solid, 0.001), Contains("a density in g/cm^3"));
  }
  CHECK_THAT(weighed(usual[1], kGravity), Contains("the density is 9307 kg/m^3, but rubbers") &&
                                              Contains("Then it would be 949 kg/m^3"));
  CHECK_THAT(implausible_density(210e9, 0.3, 1e12), !Contains("Then"));
  CHECK_FALSE(implausible_density(210e9, 0.3, std::nan("")).empty());
}

}  // namespace flexneck::geometry
