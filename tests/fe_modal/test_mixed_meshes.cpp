// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <vector>

#include <Eigen/Core>
#include <catch2/catch.hpp>

#include "fe_modal/analysis/modal_analysis.h"
#include "fe_modal/system/assembly.h"
#include "fe_modal/system/rigid_average.h"
#include "tests/fe_modal/dense.h"
#include "tests/support/block_mesh.h"
#include "tests/support/dense_solvers.h"
#include "tests/support/element_choices.h"
#include "tests/support/element_meshes.h"

namespace flexneck::fe_modal {
namespace {

using mesher::ElementKind;
using Field = std::function<Eigen::Vector3d(const Eigen::Vector3d&)>;

struct NamedMesh {
  std::string name;
  mesher::Mesh mesh;
};

void move_nodes(mesher::Mesh& mesh, const Field& position) {
  for (auto& node : mesh.nodes) {
    const Eigen::Vector3d x = position(Eigen::Vector3d(node.data()));
    node = {x[0], x[1], x[2]};
  }
}

/// Hexahedra beside prisms and, on top of these, tetrahedra; the space over the hexahedra is empty,
/// as a quadrilateral would meet two triangles there. The body is the unit cube without that
/// quarter.
mesher::Mesh three_families(ElementKind hexahedron, ElementKind prism, const Field& position,
                            const mesher::Material& material) {
  testing::BlockMesh block = testing::box({4, 2, 4}, {1, 1, 1}, material);
  block.position = [](const Eigen::Vector3d& p) { return p; };
  const auto choose = [&](const Eigen::Vector3d& p) -> std::optional<ElementKind> {
    if (p[0] < 0.5) return p[2] < 0.5 ? std::optional(hexahedron) : std::nullopt;
    return p[2] < 0.5 ? prism : ElementKind::tet10;
  };
  mesher::Mesh mesh = testing::with_kinds(block.make(), choose);
  move_nodes(mesh, position);
  return mesh;
}

/// A row of three cells: a hexahedron, pyramids on its side, tetrahedra on these.
mesher::Mesh row_with_pyramids(ElementKind hexahedron, ElementKind pyramid, ElementKind tetrahedron,
                               const Field& position, const mesher::Material& material) {
  testing::BlockMesh block = testing::box({3, 1, 1}, {1, 1, 1}, material);
  block.position = [](const Eigen::Vector3d& p) { return p; };
  mesher::Mesh mesh = testing::with_kinds(block.make(), [&](const Eigen::Vector3d& p) {
    return std::optional(p[0] < 1.0 / 3 ? hexahedron : p[0] < 2.0 / 3 ? pyramid : tetrahedron);
  });
  move_nodes(mesh, position);
  return mesh;
}

mesher::Mesh cube_of(ElementKind kind, const Field& position, const mesher::Material& material) {
  testing::BlockMesh block = testing::box({2, 2, 2}, {1, 1, 1}, material);
  block.position = position;
  return testing::with_kind(block.make(), kind);
}

bool offered_in(const mesher::Mesh& mesh, Formulation formulation) {
  return std::all_of(mesh.blocks.begin(), mesh.blocks.end(),
                     [&](const auto& block) { return offered(block.kind, formulation); });
}

std::vector<NamedMesh> patches(const Field& position, const mesher::Material& material) {
  std::vector<NamedMesh> meshes;
  meshes.reserve(kVolumes.size() + 4);
  for (const ElementKind kind : kVolumes) {
    meshes.push_back({std::string(mesher::name_of(kind)), cube_of(kind, position, material)});
  }
  meshes.push_back({"hex27, prism18, tet10",
                    three_families(ElementKind::hex27, ElementKind::prism18, position, material)});
  meshes.push_back({"hex20, prism15, tet10",
                    three_families(ElementKind::hex20, ElementKind::prism15, position, material)});
  meshes.push_back(
      {"hex27, pyramid14, tet10", row_with_pyramids(ElementKind::hex27, ElementKind::pyramid14,
                                                    ElementKind::tet10, position, material)});
  meshes.push_back(
      {"hex20, pyramid13, tet10", row_with_pyramids(ElementKind::hex20, ElementKind::pyramid13,
                                                    ElementKind::tet10, position, material)});
  return meshes;
}

Eigen::VectorXd sample(const mesher::Mesh& mesh, const Field& field) {
  Eigen::VectorXd values(static_cast<Eigen::Index>(3 * mesh.nodes.size()));
  for (std::size_t k = 0; k < mesh.nodes.size(); ++k) {
    values.segment<3>(static_cast<Eigen::Index>(3 * k)) =
        field(Eigen::Vector3d(mesh.nodes[k].data()));
  }
  return values;
}

Eigen::ArrayXi inner_dofs(const mesher::Mesh& mesh) {
  const std::vector<bool> outside = testing::outside_nodes(mesh);
  const auto count = std::count(outside.begin(), outside.end(), false);
  Eigen::ArrayXi inner(3 * count);
  Eigen::Index next = 0;
  for (std::size_t k = 0; k < outside.size(); ++k) {
    for (int a = 0; a < 3 && !outside[k]; ++a) inner[next++] = static_cast<int>(3 * k) + a;
  }
  return inner;
}

/// Largest error inside when the field is prescribed on the outside.
double patch_error(const mesher::Mesh& mesh, Formulation formulation, const Field& field) {
  const Eigen::ArrayXi inner = inner_dofs(mesh);
  REQUIRE(inner.size() > 0);
  const SystemMatrices system = assemble(mesh, DofMap(mesh, {}), {formulation});
  const Eigen::MatrixXd stiffness = dense(system.stiffness.get());
  const Eigen::VectorXd exact = sample(mesh, field);
  Eigen::VectorXd surface = exact;
  surface(inner).setZero();
  const Eigen::VectorXd reaction = stiffness * surface;
  const Eigen::VectorXd force = -reaction(inner);
  const Eigen::MatrixXd inner_stiffness = stiffness(inner, inner);
  const Eigen::VectorXd solution = testing::symmetric_solution(inner_stiffness, force);
  const Eigen::VectorXd expected = exact(inner);
  return (solution - expected).cwiseAbs().maxCoeff() / exact.cwiseAbs().maxCoeff();
}

Eigen::Vector3d linear_field(const Eigen::Vector3d& x) {
  Eigen::Matrix3d gradient;
  gradient << 1.0, -0.4, 0.3, 0.7, -0.2, 0.5, -0.6, 0.1, 0.8;
  return gradient * x + Eigen::Vector3d(0.1, -0.2, 0.3);
}

/// Position as in distorted(), but linear along each edge of 2 x 2 x 2 elements.
Eigen::Vector3d straight_edged(const Eigen::Vector3d& p) {
  const Eigen::Vector3d cell = (2 * p).array().floor().min(1.0);
  const Eigen::Vector3d local = 2 * p - cell;
  Eigen::Vector3d x = Eigen::Vector3d::Zero();
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Vector3d at(corner & 1, (corner >> 1) & 1, (corner >> 2) & 1);
    const double weight =
        (at.array() * local.array() + (1 - at.array()) * (1 - local.array())).prod();
    x += weight * testing::distorted((cell + at) / 2);
  }
  return x;
}

int zero_energy_motions(const mesher::Mesh& mesh, Formulation formulation) {
  const SystemMatrices system = assemble(mesh, DofMap(mesh, {}), {formulation});
  const Eigen::VectorXd values = testing::symmetric_eigenvalues(dense(system.stiffness.get()));
  return static_cast<int>((values.array() < 1e-12 * values.maxCoeff()).count());
}

}  // namespace

TEST_CASE("patch test: elements of all kinds, curved and mixed, reproduce every linear field") {
  constexpr double kRounding = 1e-11;
  for (const mesher::Material& material : {kSteel, kRubber}) {
    for (const NamedMesh& patch : patches(testing::distorted, material)) {
      for (const Formulation formulation : kFull) {
        if (!offered_in(patch.mesh, formulation)) continue;
        CAPTURE(patch.name, material.name, name_of(formulation));
        CHECK(patch_error(patch.mesh, formulation, linear_field) < kRounding);
      }
    }
  }
}

TEST_CASE("patch test: reduced 20-node hexahedra need straight edges") {
  // Two points per direction integrate the gradients of straight-edged elements exactly, not those
  // of curved ones.
  constexpr double kRounding = 1e-11;
  const mesher::Mesh straight = cube_of(ElementKind::hex20, straight_edged, kSteel);
  CHECK(patch_error(straight, Formulation::reduced, linear_field) < kRounding);
  const mesher::Mesh curved = cube_of(ElementKind::hex20, testing::distorted, kSteel);
  const double error = patch_error(curved, Formulation::reduced, linear_field);
  CHECK(error > 1e-6);
  CHECK(error < 1e-2);
}

TEST_CASE("patch test of second order: sheared quadratic elements reproduce pure bending") {
  // The field is sigma_xx = E z, all else zero: u = (x z, -nu y z, (-x^2 + nu (y^2 - z^2)) / 2).
  // Its divergence is linear: among the mixed elements the one with linear pressures contains it.
  constexpr double kRounding = 1e-10;
  const auto skewed = [](const Eigen::Vector3d& p) -> Eigen::Vector3d {
    Eigen::Matrix3d axes;
    axes << 1.1, 0.2, -0.3, 0.1, 0.7, 0.2, 0.15, -0.1, 0.9;
    return axes * p;
  };
  for (const mesher::Material& material : {kSteel, kRubber}) {
    const double nu = material.poissons_ratio;
    const Field bending = [nu](const Eigen::Vector3d& p) -> Eigen::Vector3d {
      const double x = p[0], y = p[1], z = p[2];
      return {x * z, -nu * y * z, (-x * x + nu * (y * y - z * z)) / 2};
    };
    for (const NamedMesh& patch : patches(skewed, material)) {
      if (mesher::order_of(patch.mesh.blocks[0].kind) == 1) continue;
      CAPTURE(patch.name, material.name);
      CHECK(patch_error(patch.mesh, Formulation::displacement, bending) < kRounding);
    }
    CHECK(patch_error(cube_of(ElementKind::hex27, skewed, material), Formulation::mixed_pressure,
                      bending) < kRounding);
    CHECK(patch_error(cube_of(ElementKind::hex20, skewed, material), Formulation::reduced,
                      bending) < kRounding);
  }
}

TEST_CASE("patches of every kind resist all but the six rigid motions") {
  for (const NamedMesh& patch : patches(testing::distorted, kRubber)) {
    for (const Formulation formulation : kFull) {
      if (!offered_in(patch.mesh, formulation)) continue;
      CAPTURE(patch.name, name_of(formulation));
      CHECK(zero_energy_motions(patch.mesh, formulation) == 6);
    }
  }
}

TEST_CASE(
    "hourglass motions of reduced 20-node hexahedra: six alone, some in a row, none abreast") {
  // A single row keeps three or four such motions. Blocks with two elements in two directions have
  // none, and fewer should not be used.
  const auto block = [](std::array<int, 3> divisions) {
    return testing::with_kind(testing::box(divisions, {1, 1, 1}, kSteel).make(),
                              ElementKind::hex20);
  };
  CHECK(zero_energy_motions(block({1, 1, 1}), Formulation::reduced) == 6 + 6);
  CHECK(zero_energy_motions(block({1, 1, 2}), Formulation::reduced) == 6 + 3);
  CHECK(zero_energy_motions(block({1, 1, 3}), Formulation::reduced) == 6 + 4);
  CHECK(zero_energy_motions(block({1, 2, 2}), Formulation::reduced) == 6);
  CHECK(zero_energy_motions(block({2, 2, 2}), Formulation::reduced) == 6);
}

TEST_CASE("a part of several kinds has the mass, centre and inertia of its volume") {
  // The body is the unit cube less the quarter x < 1/2, z > 1/2.
  constexpr double kRounding = 1e-12;
  const auto identity = [](const Eigen::Vector3d& p) { return p; };
  const mesher::Mesh mesh =
      three_families(ElementKind::hex20, ElementKind::prism15, identity, kSteel);
  REQUIRE(mesh.blocks.size() == 3);
  const RigidAverage part(mesh, "block");
  const double rho = kSteel.density_kg_m3;
  CHECK(part.gram()(0, 0) == Approx(0.75 * rho).epsilon(kRounding));
  CHECK((part.point_m() - Eigen::Vector3d(3.5 / 6, 0.5, 2.5 / 6)).norm() < kRounding);
  // The moment of inertia about y through the centre is that of boxes 1/2 x 1 x 1/2 with centres
  // (1/4, 1/4), (3/4, 1/4), (3/4, 3/4).
  double inertia = 0;
  for (const auto& [x, z] : {std::pair{0.25, 0.25}, {0.75, 0.25}, {0.75, 0.75}}) {
    inertia +=
        0.25 * rho * ((0.25 + 0.25) / 12 + std::pow(x - 3.5 / 6, 2) + std::pow(z - 2.5 / 6, 2));
  }
  CHECK(part.gram()(4, 4) == Approx(inertia).epsilon(kRounding));

  const SystemMatrices system = assemble(mesh, DofMap(mesh, {}));
  CHECK(system.nodal_mass.sum() == Approx(0.75 * rho).epsilon(kRounding));
}

TEST_CASE("an average over faces of several kinds is that of the whole face") {
  // The lower side consists of quad8 of the hexahedra and tri6 of the prisms.
  const auto identity = [](const Eigen::Vector3d& p) { return p; };
  const mesher::Mesh mesh =
      three_families(ElementKind::hex20, ElementKind::prism15, identity, kSteel);
  const mesher::FaceSet& bottom = mesh.face_set("bottom");
  REQUIRE(bottom.blocks.size() == 2);
  const RigidAverage face(mesh, bottom, {0.5, 0.5, 0});
  // For u = (x^2, 0, x y) the mean of x^2 is 1/3; the slope of x y is that of its plane x/2 + y/2 -
  // 1/4.
  const auto n = static_cast<Eigen::Index>(mesh.nodes.size());
  Eigen::Matrix3Xd field(3, n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const auto& x = mesh.nodes[static_cast<std::size_t>(k)];
    field.col(k) << x[0] * x[0], 0, x[0] * x[1];
  }
  Vector6d expected;
  expected << 1.0 / 3, 0, 0.25, 0.5, -0.5, 0;
  CHECK((face.of(field) - expected).norm() < 1e-12);
}

TEST_CASE("frequencies of a bar of three families bound those of a finer bar from above") {
  // The bar is fixed on the lower side. By Rayleigh's principle displacements of a conforming mesh
  // are too stiff.
  constexpr double kCoarse = 3e-2;
  ModalOptions options;
  options.formulation.of_others = Formulation::displacement;
  options.mode_count = 4;
  options.fixed_set = "bottom";
  const auto position = [](const Eigen::Vector3d& p) -> Eigen::Vector3d {
    return p.cwiseProduct(Eigen::Vector3d(0.1, 0.04, 0.2));
  };
  const mesher::Mesh mixed =
      three_families(ElementKind::hex27, ElementKind::prism18, position, kSteel);
  testing::BlockMesh block = testing::box({8, 4, 8}, {1, 1, 1}, kSteel);
  block.position = position;
  const mesher::Mesh finer =
      testing::with_kinds(block.make(), [](const Eigen::Vector3d& x) -> std::optional<ElementKind> {
        if (x[0] < 0.05 && x[2] > 0.1) return std::nullopt;
        return ElementKind::hex27;
      });
  const Eigen::VectorXd found = analyse_modes(mixed, options, {}).frequencies_Hz;
  const Eigen::VectorXd expected = analyse_modes(finer, options, {}).frequencies_Hz;
  const Eigen::ArrayXd excess = found.array() / expected.array() - 1;
  CHECK(excess.minCoeff() > 0);
  CHECK(excess.maxCoeff() < kCoarse);
}

TEST_CASE("a closed slit is no slit, an open one lowers the frequencies") {
  constexpr double kSame = 1e-9;
  ModalOptions options;
  options.mode_count = 4;
  options.fixed_set = "bottom";
  options.interfaces = {{"tip", "top", {0, 0, 0.2}}};
  options.attachments = {{"head", "tip", 1.0, {0, 0, 0.25}, 1e-3 * Eigen::Matrix3d::Identity()}};
  for (const ElementKind kind : {ElementKind::hex27, ElementKind::tet10}) {
    const mesher::Mesh whole =
        testing::with_kind(testing::box({4, 2, 4}, {0.05, 0.04, 0.2}, kRubber).make(), kind);
    const auto front_half = [](const Eigen::Vector3d& x) {
      return x[0] > 1e-9 && std::abs(x[2] - 0.05) < 1e-9;
    };
    const mesher::Mesh closed = testing::with_slit(whole, 0.05, true, front_half);
    const mesher::Mesh open = testing::with_slit(whole, 0.05, false, front_half);
    REQUIRE(closed.nodes.size() > whole.nodes.size());
    mesher::check(closed);
    const ModalBody none = analyse_modes(whole, options, {});
    const ModalBody tied = analyse_modes(closed, options, {});
    const ModalBody cut = analyse_modes(open, options, {});
    const auto largest_ratio = [](const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
      return (a.array() / b.array() - 1).abs().maxCoeff();
    };
    CHECK(largest_ratio(tied.frequencies_Hz, none.frequencies_Hz) < kSame);
    CHECK(largest_ratio(tied.attached.at(0).frequencies_Hz, none.attached.at(0).frequencies_Hz) <
          kSame);
    CHECK((tied.invariants.J0 - none.invariants.J0).norm() < 1e-12 * none.invariants.J0.norm());
    CHECK(tied.orthogonality < 1e-9);
    CHECK((cut.frequencies_Hz.array() < none.frequencies_Hz.array()).all());
    CHECK(cut.frequencies_Hz[0] < 0.95 * none.frequencies_Hz[0]);
    for (const Eigen::Matrix3Xd& shape : tied.shapes) {
      const mesher::Slit& slit = closed.slits.front();
      for (std::size_t p = 0; p < slit.lower.size(); ++p) {
        CHECK(shape.col(slit.lower[p]) == shape.col(slit.upper[p]));
      }
    }
  }
}

}  // namespace flexneck::fe_modal
