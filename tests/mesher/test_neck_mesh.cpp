// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <set>
#include <span>

#include <Eigen/LU>
#include <catch2/catch.hpp>

#include "geometry/foundation/error.h"
#include "geometry/foundation/temporary_folder.h"
#include "mesher/mesh/mesh_file.h"
#include "mesher/mesh/mesh_measures.h"
#include "mesher/mesh/mesh_summary.h"
#include "mesher/mesh/positions.h"
#include "mesher/mesh/shape_functions.h"
#include "tests/support/files.h"
#include "tests/support/neck_mesh.h"

namespace flexneck::mesher {
namespace {

using Catch::Matchers::Contains;
using geometry::NeckDivisions;
using geometry::NeckParameters;
using testing::bytes_of;
using testing::kInch;
using testing::neck_mesh;
using testing::neck_parameters;

const std::vector<std::string> kParts = {"base_plate", "rubber_1", "plate_1",
                                         "rubber_2",   "plate_2",  "rubber_3",
                                         "plate_3",    "rubber_4", "top_plate"};

/// Relative error of a sector's area by a parabola through three points of an arc of 30 degrees,
/// 1.5e-4; an offset of 0.4 in gives elements of up to this width at four divisions per quadrant.
constexpr double kParabola = 1.6e-4;

double annulus_m2(double outer_diameter, double inner_diameter) {
  return M_PI / 4 * (outer_diameter * outer_diameter - inner_diameter * inner_diameter);
}

/// Volumes pi / 4 (D^2 - d^2) h of the layers; shifted circles have the same area.
std::vector<double> closed_form_volumes(const NeckParameters& neck) {
  const double h = geometry::rubber_height(neck);
  const auto plate = [&](double thickness) {
    return annulus_m2(neck.plate_diameter, neck.hole_diameter) * thickness;
  };
  const auto rubber = [&](double diameter) { return annulus_m2(diameter, neck.hole_diameter) * h; };
  return {plate(neck.base_plate_thickness), rubber(neck.bottom_rubber_diameter),
          plate(neck.plate_thickness),      rubber(neck.centre_rubber_diameter),
          plate(neck.plate_thickness),      rubber(neck.centre_rubber_diameter),
          plate(neck.plate_thickness),      rubber(neck.top_rubber_diameter),
          plate(neck.top_plate_thickness)};
}

/// Centroid by the Gauss rule that is exact for triquadratic positions times their Jacobian.
Eigen::Vector3d centroid(const Mesh& mesh, const ElementBlock& block) {
  const Quadrature rule = gauss_rule(block.kind, 4);
  const ShapeTable table = tabulate(block.kind, rule.points);
  double volume = 0;
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  for (std::size_t e = 0; e < block.size(); ++e) {
    const Eigen::Matrix3Xd x = positions_of(mesh, std::span(block.nodes).subspan(27 * e, 27));
    for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
      Eigen::Matrix3d jacobian;
      for (std::size_t d = 0; d < 3; ++d) {
        jacobian.col(static_cast<Eigen::Index>(d)) = x * table.derivatives[d].col(q);
      }
      const double weight = rule.weights[q] * jacobian.determinant();
      volume += weight;
      moment += weight * (x * table.values.col(q));
    }
  }
  return moment / volume;
}

double volume_error(const NeckDivisions& divisions) {
  const auto exact = closed_form_volumes(neck_parameters("C"));
  double sum = 0;
  for (const double volume : exact) sum += volume;
  return std::abs(summarise(neck_mesh("C", divisions)).volume_m3 / sum - 1);
}

double distance(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

}  // namespace

TEST_CASE("each part of the neck has the volume and mass of its cylinder less the hole") {
  const std::string set = GENERATE("A", "B", "C", "C'");
  INFO("set " << set);
  const auto exact = closed_form_volumes(neck_parameters(set));
  const MeshSummary summary = summarise(neck_mesh(set));
  REQUIRE(summary.parts.size() == kParts.size());
  double mass_kg = 0;
  for (std::size_t p = 0; p < kParts.size(); ++p) {
    INFO(kParts[p]);
    const double density = p % 2 == 0 ? 2715.3908 : 949.4169;  // 0.0981 and 0.0343 lb/in^3
    CHECK(summary.parts[p].part == kParts[p]);
    CHECK(summary.parts[p].volume_m3 == Approx(exact[p]).epsilon(kParabola));
    CHECK(summary.parts[p].mass_kg == Approx(density * exact[p]).epsilon(kParabola));
    mass_kg += density * exact[p];
  }
  CHECK(summary.mass_kg == Approx(mass_kg).epsilon(kParabola));
}

TEST_CASE("rubber sections are shifted forward by their offsets, plates and hole are centred") {
  const NeckParameters neck = neck_parameters("C");
  const Mesh mesh = neck_mesh("C");
  // Centroid of a shifted disc less a centred hole: x = offset D^2 / (D^2 - d^2).
  const auto rubber_x = [&](double diameter, double offset) {
    return offset * annulus_m2(diameter, 0) / annulus_m2(diameter, neck.hole_diameter);
  };
  const double centre_x = rubber_x(neck.centre_rubber_diameter, neck.centre_rubber_offset);
  const std::vector<double> exact_x = {
      0, rubber_x(neck.bottom_rubber_diameter, neck.bottom_rubber_offset), 0, centre_x, 0, centre_x,
      0, rubber_x(neck.top_rubber_diameter, neck.top_rubber_offset),       0};
  const std::vector<double> heights = {
      neck.base_plate_thickness,     geometry::rubber_height(neck), neck.plate_thickness,
      geometry::rubber_height(neck), neck.plate_thickness,          geometry::rubber_height(neck),
      neck.plate_thickness,          geometry::rubber_height(neck), neck.top_plate_thickness};
  double z = 0;
  for (std::size_t p = 0; p < kParts.size(); ++p) {
    INFO(kParts[p]);
    const Eigen::Vector3d found = centroid(mesh, mesh.blocks[p]);
    CHECK(found.x() == Approx(exact_x[p]).margin(kParabola * neck.plate_diameter / 2));
    CHECK(std::abs(found.y()) < 1e-12);
    CHECK(found.z() == Approx(z + heights[p] / 2).epsilon(1e-9));
    z += heights[p];
  }
}

TEST_CASE("the necks weigh what their fits say") {
  constexpr double kRoundedTo_lb = 0.005;
  const std::map<std::string, double> fitted_lb = {
      {"A", 3.15}, {"B", 3.30}, {"C", 2.73}, {"C'", 2.69}};
  for (const auto& [set, weight_lb] : fitted_lb) {
    CHECK(summarise(neck_mesh(set)).mass_kg / 0.45359237 ==
          Approx(weight_lb).margin(kRoundedTo_lb));
  }
}

TEST_CASE("the default neck has 26400 degrees of freedom and well-shaped elements") {
  for (const char* set : {"A", "B", "C", "C'"}) {
    const MeshSummary summary = summarise(neck_mesh(set));
    CHECK(summary.degrees_of_freedom == 26400);
    // The plates are sheared between shifted circles by the geometry itself; set C most, by 56
    // degrees.
    CHECK(summary.smallest_scaled_jacobian > std::cos(57 * M_PI / 180));
  }
}

TEST_CASE("volumes converge with the fourth power of the divisions round the neck") {
  const double coarse = volume_error({.quadrant = 4});
  const double fine = volume_error({.quadrant = 8});
  CHECK(coarse / fine == Approx(16).epsilon(0.03));  // the next term has the sixth power
}

TEST_CASE("parts share their nodes: no two nodes lie in one place") {
  const Mesh mesh = neck_mesh("C");
  double nearest_m = 1;
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      nearest_m = std::min(nearest_m, distance(mesh.nodes[i], mesh.nodes[j]));
    }
  }
  CHECK(nearest_m > 0.02 * kInch);
}

TEST_CASE("base and top are the whole end faces and look away from the neck") {
  for (const char* set : {"A", "C"}) {
    const NeckParameters neck = neck_parameters(set);
    const Mesh mesh = neck_mesh(set);
    const double exact = annulus_m2(neck.plate_diameter, neck.hole_diameter);
    for (const auto& [name, z, up] : {std::tuple("base", 0.0, -1.0), {"top", neck.length, 1.0}}) {
      const FaceSet& faces = mesh.face_set(name);
      CHECK(area_m2(mesh, faces) == Approx(exact).epsilon(kParabola));
      for (const std::int32_t node : mesh.node_set(name).nodes) {
        CHECK(mesh.nodes[static_cast<std::size_t>(node)][2] == Approx(z).margin(1e-12));
      }
      REQUIRE(faces.blocks.size() == 1);
      const std::vector<std::int32_t>& nodes = faces.blocks[0].nodes;
      for (std::size_t f = 0; f < nodes.size(); f += 9) {
        const auto& a = mesh.nodes[static_cast<std::size_t>(nodes[f])];
        const auto& b = mesh.nodes[static_cast<std::size_t>(nodes[f + 1])];
        const auto& c = mesh.nodes[static_cast<std::size_t>(nodes[f + 2])];
        const double normal_z = (b[0] - a[0]) * (c[1] - b[1]) - (b[1] - a[1]) * (c[0] - b[0]);
        CHECK(up * normal_z > 0);
      }
    }
  }
}

TEST_CASE("at default divisions each bolt of each neck holds nodes of the base face") {
  for (const char* set : {"A", "B", "C", "C'"}) {
    INFO("set " << set);
    const NeckParameters neck = neck_parameters(set);
    const Mesh mesh = neck_mesh(set);
    std::array<int, 4> fixed{};
    for (const std::int32_t node : mesh.node_set("bolts").nodes) {
      const auto& x = mesh.nodes[static_cast<std::size_t>(node)];
      CHECK(std::abs(x[2]) < 1e-12);
      for (std::size_t b = 0; b < 4; ++b) {
        if (distance(x, geometry::bolt_centres(neck)[b]) <= 0.13 * kInch) ++fixed[b];
      }
    }
    for (const int count : fixed) CHECK(count > 0);
    CHECK(fixed[0] == fixed[3]);  // the neck is symmetric left to right
    CHECK(fixed[1] == fixed[2]);
  }
}

TEST_CASE("bolts too small for the mesh are refused") {
  NeckParameters neck = neck_parameters("C");
  neck.bolt_patch_radius = 0.001 * kInch;
  CHECK_THROWS_AS(mesh_script(testing::neck_mesh_options(neck), {}), InputError);
  CHECK_THROWS_WITH(mesh_script(testing::neck_mesh_options(neck), {}),
                    Contains("node set 'bolts'") && Contains("face set 'base'"));
}

TEST_CASE("gradings shrink the elements by their ratio towards rims and bonds") {
  NeckDivisions divisions{.inner_ring = 4, .outer_ring = 3, .rubber_layers = 5};
  divisions.ring_grading = 1.5;
  divisions.rubber_grading = 2;
  NeckParameters neck = neck_parameters("A");
  neck.bottom_rubber_offset = 0;  // on a centred base face radii are the circles' own
  const Mesh mesh = mesh_script(testing::neck_mesh_options(neck, divisions), {});

  std::set<long> radii_nm;
  for (const std::int32_t node : mesh.node_set("base").nodes) {
    const auto& x = mesh.nodes[static_cast<std::size_t>(node)];
    if (x[0] > 0 && std::abs(x[0] - x[1]) < 1e-9) {
      radii_nm.insert(std::lround(1e9 * std::hypot(x[0], x[1])));
    }
  }
  const std::vector<long> r(radii_nm.begin(), radii_nm.end());
  REQUIRE(r.size() == 15);  // ends and middles of seven elements
  const auto ring = [&](std::size_t i) { return static_cast<double>(r[2 * i + 2] - r[2 * i]); };
  for (std::size_t i = 0; i < 3; ++i) CHECK(ring(i) / ring(i + 1) == Approx(1.5).epsilon(1e-6));
  for (std::size_t i = 4; i < 6; ++i) CHECK(ring(i + 1) / ring(i) == Approx(1.5).epsilon(1e-6));
  CHECK(static_cast<double>(r[8]) * 1e-9 == Approx(2.55 / 2 * kInch).epsilon(1e-6));

  // Layers 1 : 2 : 4 : 2 : 1 of the rubber height.
  const ElementBlock& rubber = mesh.blocks[1];
  std::set<long> planes_nm;
  for (std::size_t e = 0; e < rubber.size(); ++e) {
    for (std::size_t corner = 0; corner < 8; ++corner) {
      const auto node = static_cast<std::size_t>(rubber.nodes[27 * e + corner]);
      planes_nm.insert(std::lround(1e9 * (mesh.nodes[node][2] - neck.base_plate_thickness)));
    }
  }
  const double h_nm = 1e9 * geometry::rubber_height(neck);
  const std::vector<double> shares = {0, 0.1, 0.3, 0.7, 0.9, 1};
  const std::vector<long> planes(planes_nm.begin(), planes_nm.end());
  REQUIRE(planes.size() == shares.size());
  for (std::size_t i = 0; i < shares.size(); ++i) {
    CHECK(static_cast<double>(planes[i]) == Approx(shares[i] * h_nm).margin(1));
  }
}

TEST_CASE("thin rings and coarse divisions do not fold elements over") {
  CHECK_NOTHROW(neck_mesh("A", {.quadrant = 2, .inner_ring = 4, .outer_ring = 3}));
  NeckParameters neck = neck_parameters("C");
  neck.bottom_rubber_offset = 0.65 * kInch;  // 0.031 in to the rim, 0.057 in to the hole
  ScriptMeshOptions options = testing::neck_mesh_options(neck);
  options.patches.clear();  // the bolts behind the rubber would need more divisions
  CHECK_NOTHROW(mesh_script(options, {}));
}

TEST_CASE("the script's own values are those of neck C") {
  ScriptMeshOptions options = testing::neck_mesh_options(neck_parameters("C"));
  const Mesh with_constants = mesh_script(options, {});
  options.constants.clear();
  const Mesh plain = mesh_script(options, {});
  REQUIRE(plain.nodes.size() == with_constants.nodes.size());
  double largest_m = 0;
  for (std::size_t n = 0; n < plain.nodes.size(); ++n) {
    largest_m = std::max(largest_m, distance(plain.nodes[n], with_constants.nodes[n]));
  }
  CHECK(largest_m < 1e-11);  // inches in binary against inches in the script, then rounded
}

TEST_CASE("meshing twice gives the same bytes in the file") {
  const TemporaryFolder folder;
  for (const char* name : {"one.h5", "two.h5"}) {
    write_mesh(folder / name, {.mesh = neck_mesh("C"), .provenance = {}});
  }
  const std::string one = bytes_of(folder / "one.h5");
  CHECK(one.size() > 100000);
  CHECK((one == bytes_of(folder / "two.h5")));  // too long to print
}

}  // namespace flexneck::mesher
