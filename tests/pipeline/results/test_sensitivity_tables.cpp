// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "pipeline/results/report/figures/tornado_figure.h"
#include "pipeline/results/tables/sensitivity_tables.h"

namespace flexneck::pipeline {
namespace {

using Catch::Matchers::Contains;
using fe_modal::QuantityKind;

/// Two parameters; a group of two modes, a single one, one with the head, a stiffness, the mass.
fe_modal::Sensitivities sample() {
  fe_modal::Sensitivities found;
  using enum QuantityKind;
  found.quantities = {{mean_frequency, "bending 1, bending 2", "Hz", 10},
                      {directional, "bending 1", "Hz", 10},
                      {directional, "bending 2", "Hz", 10},
                      {symmetry_class, "bending 1", "Hz", 10},
                      {symmetry_class, "bending 2", "Hz", 10},
                      {frequency, "torsion 1", "Hz", 20},
                      {frequency, "head on top 1", "Hz", 5, true},
                      {static_stiffness, "My/ry at top", "N m/rad", 100},
                      {mass, "mass", "kg", 2}};
  found.parameters = {{"geometry.width", "m", 0.5, {}},
                      {"geometry.materials.steel.density", "kg/m^3", 8000, {}}};
  found.derivatives.resize(9, 2);
  found.derivatives.col(0) << 10, 0, 20, 0, 20, -40, 1, 600, 4;
  found.derivatives.col(1) << -1e-3, -1e-3, -1e-3, -1e-3, -1e-3, 0, -1e-4, 0, 2.5e-4;
  found.notes = {"bending 1, bending 2 lie close"};
  return found;
}

}  // namespace

TEST_CASE("tables of sensitivities name what is differentiated") {
  const std::vector<ResultTable> tables = sensitivity_tables(sample(), {"Omitted: x: why."});
  REQUIRE(tables.size() == 4);
  CHECK(std::all_of(tables.begin(), tables.end(), is_of_sensitivities));
  CHECK(tables[0].columns.size() == 7);
  CHECK(tables[0].columns[1].name == "mean of bending 1, bending 2");
  CHECK(tables[0].columns[2].name == "bending 1, directional");
  CHECK(tables[0].columns[4].name == "bending 1, by symmetry class");
  // 10 Hz/m of 10 Hz and 0.5 m
  CHECK(tables[0].rows[0] == std::vector<std::string>{"geometry.width", "+0.5000", "0.0000",
                                                      "+1.0000", "0.0000", "+1.0000", "-1.0000"});
  CHECK(tables[0].notes.size() == 2);
  CHECK(tables[1].columns[1].name == "head on top 1");
  CHECK(tables[2].columns.back().name == "mass");
  REQUIRE(tables[3].rows.size() == 18);
  CHECK(tables[3].rows[17] == std::vector<std::string>{"mass", "mass", "no", "2", "kg",
                                                       "geometry.materials.steel.density", "8000",
                                                       "kg/m^3", "0.00025", "kg/(kg/m^3)", "1"});
}

TEST_CASE("the short table of sensitivities fits the console") {
  fe_modal::Sensitivities found = sample();
  for (int k = 0; k < 20; ++k) {
    found.quantities.insert(found.quantities.begin(),
                            {QuantityKind::frequency, "mode", "Hz", 1.0 + k});
  }
  found.derivatives = Eigen::MatrixXd::Constant(29, 2, 1e-4);
  std::istringstream lines(short_sensitivities(found));
  std::size_t longest = 0;
  for (std::string line; std::getline(lines, line);) longest = std::max(longest, line.size());
  CHECK(longest <= 100);
  CHECK_THAT(short_sensitivities(sample()),
             Contains("f1: mean of bending 1, bending 2, 10.000 Hz") && Contains("f2: torsion 1") &&
                 !Contains("directional"));
}

TEST_CASE("the tornado has a panel for each gradient, its longest bars first") {
  Results results;
  CHECK_THAT(tornado_figure(results).missing, Contains("flexneck modes --sensitivity"));
  results.tables = sensitivity_tables(sample(), {});
  const Figure figure = tornado_figure(results);
  CHECK(figure.missing.empty());
  CHECK(figure.csv ==
        "quantity,input,d ln(quantity) / d ln(input)\n"
        "\"mean of bending 1, bending 2\",geometry.materials.steel.density,-0.8000\n"
        "\"mean of bending 1, bending 2\",geometry.width,0.5000\n\n\n"
        "\"torsion 1\",geometry.width,-1.0000\n\n\n"
        "\"head on top 1\",geometry.materials.steel.density,-0.1600\n"
        "\"head on top 1\",geometry.width,0.1000\n\n\n"
        "\"My/ry at top\",geometry.width,3.0000\n\n\n"
        "\"mass\",geometry.width,1.0000\n"
        "\"mass\",geometry.materials.steel.density,1.0000\n");
  CHECK_THAT(figure.script, Contains("tornado.csv") && Contains("'materials.steel.density'"));
}

}  // namespace flexneck::pipeline
