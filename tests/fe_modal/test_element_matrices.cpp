// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <memory>

#include <Eigen/Dense>
#include <catch2/catch.hpp>

#include "fe_modal/element_matrices.h"
#include "mesher/mesh/shape_functions.h"
#include "tests/support/block_mesh.h"

namespace flexneck::fe_modal {
namespace {

using Field = std::function<Eigen::Vector3d(const Eigen::Vector3d&)>;

constexpr std::array kFormulations = {Formulation::mixed_pressure, Formulation::displacement};
const mesher::Material kSteel{"steel", 2.1e11, 0.3, 7850};
const mesher::Material kRubber{"rubber", 8.3e6, 0.49, 950};

Hex27Coordinates mapped_element(const Field& map) {
  Hex27Coordinates nodes;
  const auto reference = mesher::reference_nodes(mesher::ElementKind::hex27);
  for (int i = 0; i < 27; ++i) {
    nodes.col(i) = map(Eigen::Map<const Eigen::Vector3d>(reference[std::size_t(i)].data()));
  }
  return nodes;
}

Eigen::Vector3d skewed(const Eigen::Vector3d& p) {
  Eigen::Matrix3d axes;
  axes << 1.1, 0.2, -0.3, 0.1, 0.7, 0.2, 0.15, -0.1, 0.9;
  return 0.01 * axes * p;
}

std::unique_ptr<ElementMatrices> matrices(const Hex27Coordinates& nodes,
                                          const mesher::Material& material,
                                          Formulation formulation) {
  auto result = std::make_unique<ElementMatrices>();
  Hex27Kernel().compute(nodes, material, formulation, *result);
  return result;
}

/// Dense stiffness of a mesh, all nodes free, straight from the element matrices.
Eigen::MatrixXd dense_stiffness(const mesher::Mesh& mesh, Formulation formulation) {
  const auto size = static_cast<Eigen::Index>(3 * mesh.nodes.size());
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(size, size);
  for (const mesher::ElementBlock& block : mesh.blocks) {
    for (std::size_t e = 0; e < block.size(); ++e) {
      std::vector<Eigen::Index> dofs;
      Hex27Coordinates nodes;
      for (std::size_t i = 0; i < 27; ++i) {
        const auto node = static_cast<std::size_t>(block.nodes[27 * e + i]);
        nodes.col(static_cast<Eigen::Index>(i)) =
            Eigen::Map<const Eigen::Vector3d>(mesh.nodes[node].data());
        for (std::size_t a = 0; a < 3; ++a) dofs.push_back(static_cast<Eigen::Index>(3 * node + a));
      }
      stiffness(dofs, dofs) +=
          matrices(nodes, mesh.materials[block.material], formulation)->stiffness;
    }
  }
  return stiffness;
}

Eigen::VectorXd sample(const mesher::Mesh& mesh, const Field& field) {
  Eigen::VectorXd values(static_cast<Eigen::Index>(3 * mesh.nodes.size()));
  for (std::size_t k = 0; k < mesh.nodes.size(); ++k) {
    values.segment<3>(static_cast<Eigen::Index>(3 * k)) =
        field(Eigen::Map<const Eigen::Vector3d>(mesh.nodes[k].data()));
  }
  return values;
}

/// Degrees of freedom of the nodes inside a box of 2 x 2 x 2 elements.
Eigen::ArrayXi inner_dofs() {
  Eigen::ArrayXi dofs(81);
  Eigen::Index count = 0;
  for (int k = 1; k < 4; ++k) {
    for (int j = 1; j < 4; ++j) {
      for (int i = 1; i < 4; ++i) {
        for (int a = 0; a < 3; ++a) dofs[count++] = 3 * ((k * 5 + j) * 5 + i) + a;
      }
    }
  }
  return dofs;
}

/// Largest error inside when the field is prescribed on the surface of 2 x 2 x 2 elements.
double patch_error(const mesher::Mesh& mesh, Formulation formulation, const Field& field) {
  const Eigen::MatrixXd stiffness = dense_stiffness(mesh, formulation);
  const Eigen::VectorXd exact = sample(mesh, field);
  const Eigen::ArrayXi inner = inner_dofs();
  Eigen::VectorXd surface = exact;
  surface(inner).setZero();
  const Eigen::VectorXd reaction = stiffness * surface;
  const Eigen::VectorXd force = -reaction(inner);
  const Eigen::MatrixXd inner_stiffness = stiffness(inner, inner);
  const Eigen::VectorXd solution = inner_stiffness.ldlt().solve(force);
  const Eigen::VectorXd expected = exact(inner);
  return (solution - expected).cwiseAbs().maxCoeff() / exact.cwiseAbs().maxCoeff();
}

}  // namespace

TEST_CASE("patch test: distorted elements reproduce every linear field") {
  constexpr double kRounding = 1e-12;
  Eigen::Matrix3d gradient;
  gradient << 1.0, -0.4, 0.3, 0.7, -0.2, 0.5, -0.6, 0.1, 0.8;
  const Field linear = [&](const Eigen::Vector3d& x) -> Eigen::Vector3d {
    return gradient * x + Eigen::Vector3d(0.1, -0.2, 0.3);
  };
  for (const mesher::Material& material : {kSteel, kRubber}) {
    testing::BlockMesh block = testing::box({2, 2, 2}, {1, 1, 1}, material);
    block.position = testing::distorted;
    for (const Formulation formulation : kFormulations) {
      CHECK(patch_error(block.make(), formulation, linear) < kRounding);
    }
  }
}

TEST_CASE("patch test of second order: sheared boxes reproduce pure bending") {
  // sigma_xx = E z, all else zero: u = (x z, -nu y z, (-x^2 + nu (y^2 - z^2)) / 2).
  constexpr double kRounding = 1e-11;
  for (const mesher::Material& material : {kSteel, kRubber}) {
    const double nu = material.poissons_ratio;
    const Field bending = [nu](const Eigen::Vector3d& p) -> Eigen::Vector3d {
      const double x = p[0], y = p[1], z = p[2];
      return {x * z, -nu * y * z, (-x * x + nu * (y * y - z * z)) / 2};
    };
    testing::BlockMesh block = testing::box({2, 2, 2}, {1, 1, 1}, material);
    block.position = skewed;
    for (const Formulation formulation : kFormulations) {
      CHECK(patch_error(block.make(), formulation, bending) < kRounding);
    }
  }
}

TEST_CASE("an element resists everything but its six rigid motions") {
  constexpr double kZero = 1e-13;
  constexpr double kStiff = 1e-6;  // the softest deformation against the stiffest
  const Hex27Coordinates nodes = mapped_element(
      [](const Eigen::Vector3d& p) { return testing::distorted(0.5 * (p.array() + 1)); });
  for (const mesher::Material& material : {kSteel, kRubber}) {
    for (const Formulation formulation : kFormulations) {
      const Eigen::MatrixXd stiffness = matrices(nodes, material, formulation)->stiffness;
      const Eigen::VectorXd values =
          Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(stiffness).eigenvalues();
      CHECK(values.head(6).cwiseAbs().maxCoeff() < kZero * values[80]);
      CHECK(values[6] > kStiff * values[80]);
    }
  }
}

TEST_CASE("the displacement formulation is the integral of B^T D B") {
  // Independent: Voigt notation and a finer rule; on a parallelepiped both rules are exact.
  constexpr double kRounding = 1e-12;
  const Hex27Coordinates nodes = mapped_element(skewed);
  const double nu = kSteel.poissons_ratio;
  const double factor = kSteel.youngs_modulus_Pa / ((1 + nu) * (1 - 2 * nu));
  Eigen::Matrix<double, 6, 6> elasticity = Eigen::Matrix<double, 6, 6>::Zero();
  elasticity.topLeftCorner<3, 3>().setConstant(factor * nu);
  elasticity.diagonal() << 1 - nu, 1 - nu, 1 - nu, 0.5 - nu, 0.5 - nu, 0.5 - nu;
  elasticity.diagonal() *= factor;

  const mesher::Quadrature rule = mesher::gauss_rule(mesher::ElementKind::hex27, 4);
  const mesher::ShapeTable table = mesher::tabulate(mesher::ElementKind::hex27, rule.points);
  Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(81, 81);
  for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
    Eigen::Matrix<double, 27, 3> reference;
    for (std::size_t a = 0; a < 3; ++a) {
      reference.col(static_cast<Eigen::Index>(a)) = table.derivatives[a].col(q);
    }
    const Eigen::Matrix3d jacobian = nodes * reference;
    const Eigen::Matrix<double, 27, 3> g = reference * jacobian.inverse();
    Eigen::Matrix<double, 6, 81> strain = Eigen::Matrix<double, 6, 81>::Zero();
    for (int i = 0; i < 27; ++i) {
      strain.middleCols<3>(3 * i) << g(i, 0), 0, 0, 0, g(i, 1), 0, 0, 0, g(i, 2), g(i, 1), g(i, 0),
          0, 0, g(i, 2), g(i, 1), g(i, 2), 0, g(i, 0);
    }
    expected += rule.weights[q] * jacobian.determinant() * strain.transpose() * elasticity * strain;
  }
  const auto found = matrices(nodes, kSteel, Formulation::displacement);
  CHECK((found->stiffness - expected).norm() < kRounding * expected.norm());
}

TEST_CASE("projecting the pressure only ever softens an element") {
  const Hex27Coordinates nodes = mapped_element(
      [](const Eigen::Vector3d& p) { return testing::distorted(0.5 * (p.array() + 1)); });
  const Eigen::MatrixXd mixed = matrices(nodes, kRubber, Formulation::mixed_pressure)->stiffness;
  const Eigen::MatrixXd full = matrices(nodes, kRubber, Formulation::displacement)->stiffness;
  const Eigen::VectorXd difference =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(full - mixed).eigenvalues();
  CHECK(difference.minCoeff() > -1e-13 * full.norm());
  CHECK(difference.maxCoeff() > 0.1 * full.norm());
}

TEST_CASE("the consistent mass of a box is the product of three line masses") {
  // int_-1^1 of products of the quadratic functions at -1, 0, 1
  constexpr double kRounding = 1e-14;
  Eigen::Matrix3d line;
  line << 4, 2, -1, 2, 16, 2, -1, 2, 4;
  line /= 15;
  const auto found = matrices(mapped_element(skewed), kSteel, Formulation::mixed_pressure);
  Eigen::Matrix3d axes;
  axes << skewed({1, 0, 0}), skewed({0, 1, 0}), skewed({0, 0, 1});
  const double density = kSteel.density_kg_m3 * axes.determinant();
  const auto reference = mesher::reference_nodes(mesher::ElementKind::hex27);
  for (int i = 0; i < 27; ++i) {
    for (int j = 0; j < 27; ++j) {
      double expected = density;
      for (std::size_t a = 0; a < 3; ++a) {
        expected *= line(static_cast<int>(reference[std::size_t(i)][a]) + 1,
                         static_cast<int>(reference[std::size_t(j)][a]) + 1);
      }
      CHECK(std::abs(found->mass(i, j) - expected) < kRounding * density);
    }
  }
}

}  // namespace flexneck::fe_modal
