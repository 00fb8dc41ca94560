// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>

#include <Eigen/Dense>
#include <catch2/catch.hpp>

#include "fe_modal/reduction/invariants.h"
#include "mesher/mesh/shape_functions.h"
#include "tests/support/block_mesh.h"

namespace flexneck::fe_modal {
namespace {

constexpr double kRounding = 1e-12;
constexpr int kModes = 3;

Eigen::Matrix3d skew(const Eigen::Vector3d& v) {
  Eigen::Matrix3d result;
  result << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return result;
}

/// Boxes of two materials, with constant Jacobians, for which both quadrature rules of this test
/// are exact.
mesher::Mesh sandwich() {
  testing::BlockMesh block = testing::box({2, 1, 3}, {0.2, 0.1, 0.3}, {});
  block.slices = {{"plate", 1, {"steel", 2.1e11, 0.3, 7850}},
                  {"pad", 2, {"rubber", 8.3e6, 0.49, 950}}};
  return block.make();
}

std::vector<Eigen::Matrix3Xd> random_shapes(Eigen::Index nodes) {
  std::srand(7);
  std::vector<Eigen::Matrix3Xd> shapes;
  for (int l = 0; l < kModes; ++l) shapes.push_back(Eigen::Matrix3Xd::Random(3, nodes));
  return shapes;
}

/// Blocks of the mass matrix of the deformed body (equations.md, section 2), in body axes.
struct DeformedBody {
  double mass = 0;
  Eigen::Vector3d S = Eigen::Vector3d::Zero();  ///< int rho s
  Eigen::Matrix3d J = Eigen::Matrix3d::Zero();  ///< -int rho ~s ~s
  Eigen::Matrix<double, 3, kModes> N =
      Eigen::Matrix<double, 3, kModes>::Zero();  ///< int rho ~s psi
  Eigen::Matrix<double, 3, kModes> S2 = Eigen::Matrix<double, 3, kModes>::Zero();
  Eigen::Matrix<double, kModes, kModes> Maa = Eigen::Matrix<double, kModes, kModes>::Zero();
};

/// Integrates by quadrature over the undeformed volume with the deformed positions s = s0 + psi a.
DeformedBody integrate(const mesher::Mesh& mesh, const std::vector<Eigen::Matrix3Xd>& shapes,
                       const Eigen::Vector3d& a) {
  const mesher::Quadrature rule = mesher::gauss_rule(mesher::ElementKind::hex27, 4);
  const mesher::ShapeTable table = mesher::tabulate(mesher::ElementKind::hex27, rule.points);
  DeformedBody body;
  for (const mesher::ElementBlock& block : mesh.blocks) {
    for (std::size_t e = 0; e < block.size(); ++e) {
      for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
        Eigen::Matrix3d jacobian = Eigen::Matrix3d::Zero();
        Eigen::Vector3d s = Eigen::Vector3d::Zero();
        Eigen::Matrix<double, 3, kModes> psi = Eigen::Matrix<double, 3, kModes>::Zero();
        for (std::size_t i = 0; i < 27; ++i) {
          const std::int32_t node = block.nodes[27 * e + i];
          const auto row = static_cast<Eigen::Index>(i);
          const Eigen::Map<const Eigen::Vector3d> x(mesh.nodes[std::size_t(node)].data());
          s += table.values(row, q) * x;
          for (std::size_t b = 0; b < 3; ++b) {
            jacobian.col(static_cast<Eigen::Index>(b)) += table.derivatives[b](row, q) * x;
          }
          for (std::size_t l = 0; l < kModes; ++l) {
            psi.col(static_cast<Eigen::Index>(l)) += table.values(row, q) * shapes[l].col(node);
          }
        }
        s += psi * a;
        const double dm =
            mesh.materials[block.material].density_kg_m3 * rule.weights[q] * jacobian.determinant();
        body.mass += dm;
        body.S += dm * s;
        body.J -= dm * skew(s) * skew(s);
        body.N += dm * skew(s) * psi;
        body.S2 += dm * psi;
        body.Maa += dm * psi.transpose() * psi;
      }
    }
  }
  return body;
}

}  // namespace

TEST_CASE("invariants give the mass matrix of the deformed body") {
  const mesher::Mesh mesh = sandwich();
  const std::vector<Eigen::Matrix3Xd> shapes =
      random_shapes(static_cast<Eigen::Index>(mesh.nodes.size()));
  const SystemMatrices system = assemble(mesh, DofMap(mesh, {}));
  const InertiaInvariants found = inertia_invariants(system.nodal_mass, mesh.nodes, shapes);
  for (const Eigen::Vector3d& a :
       {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(0.03, -0.07, 0.05), Eigen::Vector3d(0, 0.1, 0)}) {
    const DeformedBody expected = integrate(mesh, shapes, a);
    const Eigen::Vector3d S = found.S1 + found.S2 * a;
    Eigen::Matrix3d J = found.J0;
    Eigen::Matrix3Xd N = found.N0;
    for (Eigen::Index l = 0; l < kModes; ++l) {
      const Eigen::Matrix3d& G0 = found.G0[std::size_t(l)];
      J += a[l] * (G0 + G0.transpose());
      for (Eigen::Index j = 0; j < kModes; ++j) {
        const auto index = static_cast<std::size_t>(j * kModes + l);
        J += a[j] * a[l] * found.G[index];
        N.col(l) += a[j] * found.N[index];
      }
    }
    CHECK(found.mass == Approx(expected.mass).epsilon(kRounding));
    CHECK((S - expected.S).norm() < kRounding * expected.S.norm());
    CHECK((J - expected.J).norm() < kRounding * expected.J.norm());
    CHECK((N - expected.N).norm() < kRounding * expected.N.norm());
    CHECK((found.S2 - expected.S2).norm() < kRounding * expected.S2.norm());
    CHECK((found.Maa - expected.Maa).norm() < kRounding * expected.Maa.norm());
  }
}

TEST_CASE("the gradients of the inertia, which act as forces, are those of the deformed body") {
  // dJ/da_l = G_l(a) + G_l(a)^T with G_l(a) = G0_l + sum_j a_j G_jl, and the single G_l(a) itself
  // is -int rho ~s ~psi_l: J alone would not see an exchange of j and l.
  const mesher::Mesh mesh = sandwich();
  const std::vector<Eigen::Matrix3Xd> shapes =
      random_shapes(static_cast<Eigen::Index>(mesh.nodes.size()));
  const SystemMatrices system = assemble(mesh, DofMap(mesh, {}));
  const InertiaInvariants found = inertia_invariants(system.nodal_mass, mesh.nodes, shapes);
  for (std::size_t j = 0; j < kModes; ++j) {
    for (std::size_t l = 0; l < kModes; ++l) {
      const std::size_t jl = j * kModes + l;
      // -~p ~q = (p.q) I - q p^T: twice its axial vector is p x q, which N contains, but not the J
      // of a deformed body.
      const Eigen::Matrix3d& G = found.G[jl];
      const Eigen::Vector3d axial(G(2, 1) - G(1, 2), G(0, 2) - G(2, 0), G(1, 0) - G(0, 1));
      CHECK((axial + found.N[jl]).norm() < kRounding);
      CHECK((found.N[jl] + found.N[l * kModes + j]).norm() < kRounding);
    }
    const Eigen::Matrix3d& G0 = found.G0[j];
    const Eigen::Vector3d axial(G0(2, 1) - G0(1, 2), G0(0, 2) - G0(2, 0), G0(1, 0) - G0(0, 1));
    CHECK((axial + found.N0.col(static_cast<Eigen::Index>(j))).norm() < kRounding);
  }
}

TEST_CASE("a box without modes has the mass properties of a box") {
  const Eigen::Vector3d size(0.2, 0.1, 0.3);
  const mesher::Mesh mesh = testing::box({1, 2, 2}, size, {"steel", 2.1e11, 0.3, 7850}).make();
  const SystemMatrices system = assemble(mesh, DofMap(mesh, {}));
  const InertiaInvariants found = inertia_invariants(system.nodal_mass, mesh.nodes, {});
  const double mass = 7850 * size.prod();
  CHECK(found.mass == Approx(mass).epsilon(kRounding));
  CHECK((found.S1 - mass * Eigen::Vector3d(0, 0, 0.15)).norm() < kRounding * mass);
  // The moments of inertia are about the origin, the middle of the bottom.
  const Eigen::Vector3d expected(mass * (0.01 / 12 + 0.09 / 3), mass * (0.04 / 12 + 0.09 / 3),
                                 mass * (0.04 + 0.01) / 12);
  CHECK((found.J0 - Eigen::Matrix3d(expected.asDiagonal())).norm() < kRounding * mass);
}

}  // namespace flexneck::fe_modal
