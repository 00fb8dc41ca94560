// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include "fe_modal/analysis/modal_analysis.h"
#include "fe_modal/system/memory_needs.h"
#include "fe_modal/system/modal_options_check.h"
#include "geometry/foundation/available_memory.h"
#include "geometry/foundation/error.h"
#include "tests/support/block_mesh.h"
#include "tests/support/element_meshes.h"

namespace flexneck::fe_modal {
namespace {

mesher::Mesh bar() {
  return testing::box({1, 1, 2}, {0.1, 0.1, 0.4}, {"steel", 2.1e11, 0.3, 7850}).make();
}

ModalOptions sound_options() {
  ModalOptions options;
  options.mode_count = 2;
  options.fixed_set = "bottom";
  options.fixed_interface = "root";
  options.interfaces = {{"tip", "top", {0, 0, 0.4}}};
  options.rigid_parts = {"block"};
  options.sign_interface = "tip";
  options.length_m = 0.4;
  options.attachments = {{"mass", "tip", 1.0, {0, 0, 0.4}, Eigen::Matrix3d::Zero()}};
  return options;
}

/// Checks that the options, once spoilt, are refused with a message that contains the text.
void check_refused(const std::function<void(ModalOptions&)>& spoil, const std::string& text) {
  ModalOptions options = sound_options();
  spoil(options);
  CHECK_THROWS_AS(analyse_modes(bar(), options, {}), InputError);
  CHECK_THROWS_WITH(analyse_modes(bar(), options, {}), Catch::Contains(text));
}

}  // namespace

TEST_CASE("sound options are accepted and progress is told") {
  std::vector<std::string> lines;
  analyse_modes(bar(), sound_options(), [&](const std::string& line) { lines.push_back(line); });
  REQUIRE_FALSE(lines.empty());
  CHECK_THAT(lines[0], Catch::Contains("108 degrees of freedom"));
  for (const std::string& line : lines) CHECK(line.find('\n') == std::string::npos);
  CHECK(std::any_of(lines.begin(), lines.end(), [](const std::string& line) {
    return line.find("the factor has") != std::string::npos;
  }));
}

TEST_CASE("unknown names are refused with what there is") {
  check_refused([](ModalOptions& o) { o.fixed_set = "bolts"; }, "bottom");
  check_refused([](ModalOptions& o) { o.interfaces[0].set = "tap"; }, "top");
  check_refused([](ModalOptions& o) { o.rigid_parts = {"blok"}; }, "block");
  check_refused([](ModalOptions& o) { o.sign_interface = "tap"; }, "tip");
  check_refused([](ModalOptions& o) { o.attachments[0].interface = "head"; }, "tip");
}

TEST_CASE("impossible options are refused") {
  check_refused([](ModalOptions& o) { o.formulation.of_others = Formulation::reduced; },
                "part 'block': elements of kind hex27 have no formulation 'reduced', expected one "
                "of mixed_pressure, displacement");
  check_refused([](ModalOptions& o) { o.mode_count = 0; }, "number of modes");
  check_refused([](ModalOptions& o) { o.mode_count = 109; }, "108 degrees of freedom");
  check_refused([](ModalOptions& o) { o.length_m = 0; }, "length");
  check_refused([](ModalOptions& o) { o.attachments[0].mass_kg = -1; }, "negative");
  check_refused([](ModalOptions& o) { o.fixed_interface = "tip"; }, "tip");
  check_refused([](ModalOptions& o) { o.fixed_set.clear(); }, "free body");
}

TEST_CASE("materials and sets that cannot be are refused, whoever made the mesh") {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const auto check_mesh_refused = [](const std::function<void(mesher::Mesh&)>& spoil,
                                     const std::string& text) {
    mesher::Mesh mesh = bar();
    spoil(mesh);
    CHECK_THROWS_AS(analyse_modes(mesh, sound_options(), {}), InputError);
    CHECK_THROWS_WITH(analyse_modes(mesh, sound_options(), {}), Catch::Contains(text));
  };
  for (const double density : {-1.0, 0.0, kNan}) {
    check_mesh_refused([&](mesher::Mesh& mesh) { mesh.materials[0].density_kg_m3 = density; },
                       "material 'steel': density must be > 0");
  }
  for (const double ratio : {0.5, 0.6, kNan}) {
    check_mesh_refused([&](mesher::Mesh& mesh) { mesh.materials[0].poissons_ratio = ratio; },
                       "material 'steel': Poisson's ratio must lie between -1 and 0.5");
  }
  check_mesh_refused([](mesher::Mesh& mesh) { mesh.node_sets[0].nodes.clear(); },
                     "node set 'bottom' is empty");
}

TEST_CASE("each material has its formulation, and one that locks is warned of") {
  testing::BlockMesh pad = testing::box({1, 1, 1}, {0.08, 0.08, 0.03}, {});
  pad.slices = {{"pad", 2, {"rubber", 8.3e6, 0.49, 950}},
                {"plate", 1, {"steel", 2.1e11, 0.3, 7850}}};
  const mesher::Mesh mesh = pad.make();
  const auto lowest = [&](const FormulationChoice& choice) {
    ModalOptions options;
    options.fixed_set = "bottom";
    options.mode_count = 1;
    options.formulation = choice;
    return analyse_modes(mesh, options, {}).frequencies_Hz[0];
  };
  FormulationChoice rubber_locks;
  rubber_locks.of_material["rubber"] = Formulation::displacement;
  FormulationChoice plate_only;
  plate_only.of_material["steel"] = Formulation::displacement;
  const double mixed = lowest({});
  CHECK(lowest(rubber_locks) > 1.01 * mixed);
  CHECK(std::abs(lowest(plate_only) / mixed - 1) < 1e-3);
  CHECK(lowest({Formulation::displacement}) > 1.01 * mixed);

  CHECK(locking_warnings(mesh, {}).empty());
  CHECK(locking_warnings(mesh, plate_only).empty());
  const auto warnings = locking_warnings(mesh, rubber_locks);
  REQUIRE(warnings.size() == 1);
  CHECK_THAT(warnings[0], Catch::Contains("'rubber' with Poisson's ratio 0.49"));
  for (const auto kind : {mesher::ElementKind::tet4, mesher::ElementKind::pyramid5}) {
    const auto linear = locking_warnings(testing::with_kind(mesh, kind), {});
    REQUIRE(linear.size() == 2);  // one line for each part
    CHECK_THAT(linear[0], Catch::Contains("part 'pad' has elements of kind " +
                                          std::string(mesher::name_of(kind))));
  }
  for (const double length_m : {0.09, 0.5}) {
    const mesher::Mesh strip = testing::with_kind(
        testing::box({1, 1, 1}, {0.01, 0.01, length_m}, {"steel", 2.1e11, 0.3, 7850}).make(),
        mesher::ElementKind::tet10);
    const auto slender = locking_warnings(strip, {});
    REQUIRE(slender.size() == (length_m > 0.1 ? 1 : 0));
    if (!slender.empty())
      CHECK_THAT(slender[0], Catch::Contains("of kind tet10 with an aspect ratio of up to 5") &&
                                 Catch::Contains("a single layer of them is too stiff"));
  }

  ModalOptions unknown;
  unknown.fixed_set = "bottom";
  unknown.formulation.of_material["ruber"] = Formulation::displacement;
  CHECK_THROWS_WITH(analyse_modes(mesh, unknown, {}), Catch::Contains("did you mean 'rubber'"));
}

TEST_CASE(
    "what is for a fixed body is refused where a fixed set lets the body turn, which is named") {
  mesher::Mesh mesh = bar();
  mesh.node_sets.push_back({"edge", {0, 1, 2}});
  ModalOptions options = sound_options();
  options.fixed_set = "edge";
  CHECK_THROWS_AS(analyse_modes(mesh, options, {}), InputError);
  CHECK_THROWS_WITH(analyse_modes(mesh, options, {}),
                    Catch::Contains("attached to a body that rotates about"));
}

TEST_CASE("what an analysis takes is estimated within a fifth of what was measured") {
  // The data are degrees of freedom and GB of necks of 27-node hexahedra,
  // tests/benchmarks/README.md.
  const std::vector<std::pair<double, double>> measured_GB = {
      {11868, 0.15}, {26388, 0.27}, {64344, 0.72}, {191388, 2.6}};
  for (const auto& [dofs, measured] : measured_GB)
    CHECK(memory_needs(dofs, 10).peak == Approx(1e9 * measured).epsilon(0.2));
  // Modes take memory, too.
  CHECK(memory_needs(1e5, 1000).assembling > memory_needs(1e5, 10).assembling + 8e5 * 1000);
}

TEST_CASE("the finer mesh of a check is refused where it does not fit") {
  // The mesh takes half of the free memory; eight times the degrees of freedom take eight times as
  // much.
  const double per_dof = memory_needs(1e6, 10).assembling / 1e6;
  mesher::Mesh mesh;
  mesh.nodes.resize(static_cast<std::size_t>(available_memory() / (2 * 3 * per_dof)));
  ModalOptions options;
  CHECK_NOTHROW(check_memory(mesh, options));
  options.check = true;
  CHECK_THROWS_WITH(check_memory(mesh, options), Catch::Contains("omit modes.check"));
}

}  // namespace flexneck::fe_modal
