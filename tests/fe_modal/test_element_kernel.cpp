// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <functional>
#include <vector>

#include <Eigen/LU>
#include <catch2/catch.hpp>

#include "fe_modal/element/element_kernel.h"
#include "geometry/foundation/error.h"
#include "mesher/mesh/shape_functions.h"
#include "tests/support/block_mesh.h"
#include "tests/support/dense_solvers.h"
#include "tests/support/element_choices.h"

namespace flexneck::fe_modal {
namespace {

using mesher::ElementKind;
using Map = std::function<Eigen::Vector3d(const Eigen::Vector3d&)>;

Eigen::Matrix3Xd mapped_element(ElementKind kind, const Map& map) {
  const auto reference = mesher::reference_nodes(kind);
  Eigen::Matrix3Xd nodes(3, static_cast<Eigen::Index>(reference.size()));
  for (std::size_t i = 0; i < reference.size(); ++i) {
    nodes.col(static_cast<Eigen::Index>(i)) = map(Eigen::Vector3d(reference[i].data()));
  }
  return nodes;
}

Eigen::Vector3d skewed(const Eigen::Vector3d& p) {
  Eigen::Matrix3d axes;
  axes << 1.1, 0.2, -0.3, 0.1, 0.7, 0.2, 0.15, -0.1, 0.9;
  return 0.01 * axes * p;
}

Eigen::Vector3d bent(const Eigen::Vector3d& p) { return testing::distorted(0.5 * (p.array() + 1)); }

ElementMatrices matrices(ElementKind kind, const Map& map, const mesher::Material& material,
                         Formulation formulation) {
  ElementMatrices result;
  ElementKernel(element_scheme(kind, formulation))
      .compute(mapped_element(kind, map), material, result);
  return result;
}

/// Strength of the strongest available rule.
int strongest_rule(ElementKind kind) {
  return mesher::shape_of(kind) == mesher::ReferenceShape::tetrahedron ? 3 : 4;
}

/// Integrals of B^T D B in Voigt notation and N^T N, with the strongest rule.
ElementMatrices independent_integrals(ElementKind kind, const Eigen::Matrix3Xd& nodes,
                                      const mesher::Material& material) {
  const double nu = material.poissons_ratio;
  const double factor = material.youngs_modulus_Pa / ((1 + nu) * (1 - 2 * nu));
  Eigen::Matrix<double, 6, 6> elasticity = Eigen::Matrix<double, 6, 6>::Zero();
  elasticity.topLeftCorner<3, 3>().setConstant(factor * nu);
  elasticity.diagonal() << 1 - nu, 1 - nu, 1 - nu, 0.5 - nu, 0.5 - nu, 0.5 - nu;
  elasticity.diagonal() *= factor;
  const Eigen::Index n = nodes.cols();
  const mesher::Quadrature rule = mesher::gauss_rule(kind, strongest_rule(kind));
  const mesher::ShapeTable table = mesher::tabulate(kind, rule.points);
  ElementMatrices result{Eigen::MatrixXd::Zero(3 * n, 3 * n), Eigen::MatrixXd::Zero(n, n)};
  for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
    Eigen::MatrixXd reference(n, 3);
    for (std::size_t a = 0; a < 3; ++a) {
      reference.col(static_cast<Eigen::Index>(a)) = table.derivatives[a].col(q);
    }
    const Eigen::Matrix3d jacobian = nodes * reference;
    const Eigen::MatrixXd g = reference * jacobian.inverse();
    Eigen::MatrixXd strain = Eigen::MatrixXd::Zero(6, 3 * n);
    for (Eigen::Index i = 0; i < n; ++i) {
      strain.col(i) << g(i, 0), 0, 0, g(i, 1), 0, g(i, 2);
      strain.col(n + i) << 0, g(i, 1), 0, g(i, 0), g(i, 2), 0;
      strain.col(2 * n + i) << 0, 0, g(i, 2), 0, g(i, 1), g(i, 0);
    }
    const double volume = rule.weights[q] * jacobian.determinant();
    result.stiffness += volume * strain.transpose() * elasticity * strain;
    result.mass +=
        volume * material.density_kg_m3 * table.values.col(q) * table.values.col(q).transpose();
  }
  return result;
}

}  // namespace

TEST_CASE("stiffness and mass are the integrals of B^T D B and N^T N") {
  // On a parallelepiped the kernel's rules are exact, and so is the finer one.
  constexpr double kRounding = 1e-12;
  for (const ElementKind kind : kVolumes) {
    CAPTURE(mesher::name_of(kind));
    const ElementMatrices found = matrices(kind, skewed, kSteel, Formulation::displacement);
    const ElementMatrices expected =
        independent_integrals(kind, mapped_element(kind, skewed), kSteel);
    CHECK((found.stiffness - expected.stiffness).norm() < kRounding * expected.stiffness.norm());
    CHECK((found.mass - expected.mass).norm() < kRounding * expected.mass.norm());
  }
}

TEST_CASE("an element resists everything but its six rigid motions") {
  constexpr double kZero = 1e-13;
  constexpr double kStiff = 1e-7;  // ratio of the softest to the stiffest deformation
  for (const ElementKind kind : kVolumes) {
    for (const mesher::Material& material : {kSteel, kRubber}) {
      for (const Formulation formulation : kFull) {
        if (!offered(kind, formulation)) continue;
        CAPTURE(mesher::name_of(kind), name_of(formulation), material.name);
        const Eigen::VectorXd values =
            testing::symmetric_eigenvalues(matrices(kind, bent, material, formulation).stiffness);
        const double largest = values[values.size() - 1];
        CHECK(values.head(6).cwiseAbs().maxCoeff() < kZero * largest);
        CHECK(values[6] > kStiff * largest);
      }
    }
  }
}

TEST_CASE("reduced integration leaves a 20-node hexahedron six hourglass motions") {
  // Eight points have 48 strains, 12 short of 60. Neighbours are treated in test_mixed_meshes.cpp.
  constexpr double kZero = 1e-13;
  const Eigen::VectorXd values = testing::symmetric_eigenvalues(
      matrices(ElementKind::hex20, bent, kSteel, Formulation::reduced).stiffness);
  CHECK(values.head(12).cwiseAbs().maxCoeff() < kZero * values[59]);
  CHECK(values[12] > 1e-6 * values[59]);
}

TEST_CASE("projecting the pressure only ever softens an element") {
  for (const ElementKind kind : kVolumes) {
    if (!offered(kind, Formulation::mixed_pressure)) continue;
    CAPTURE(mesher::name_of(kind));
    const Eigen::MatrixXd mixed =
        matrices(kind, bent, kRubber, Formulation::mixed_pressure).stiffness;
    const Eigen::MatrixXd full = matrices(kind, bent, kRubber, Formulation::displacement).stiffness;
    const Eigen::VectorXd difference = testing::symmetric_eigenvalues(full - mixed);
    CHECK(difference.minCoeff() > -1e-13 * full.norm());
    CHECK(difference.maxCoeff() > 0.03 * full.norm());
  }
}

TEST_CASE("the mass of a curved element is its volume times the density") {
  // The stronger rule is exact too: the determinant's degree is at most 5 in each direction.
  constexpr double kRounding = 1e-12;
  for (const ElementKind kind : kVolumes) {
    CAPTURE(mesher::name_of(kind));
    const Eigen::MatrixXd found = matrices(kind, bent, kSteel, Formulation::displacement).mass;
    const Eigen::Matrix3Xd nodes = mapped_element(kind, bent);
    const Eigen::MatrixXd expected = independent_integrals(kind, nodes, kSteel).mass;
    CHECK(found.sum() == Approx(expected.sum()).epsilon(kRounding));
  }
}

TEST_CASE("an inverted element and a formulation that a kind has not are refused") {
  ElementMatrices result;
  for (const ElementKind kind : kVolumes) {
    CAPTURE(mesher::name_of(kind));
    const auto mirrored = [](const Eigen::Vector3d& p) -> Eigen::Vector3d {
      return {-p[0], p[1], p[2]};
    };
    CHECK_THROWS_AS(matrices(kind, mirrored, kSteel, Formulation::displacement), ComputationError);
  }
  CHECK_THROWS_WITH(element_scheme(ElementKind::tet10, Formulation::reduced),
                    Catch::Contains("tet10") && Catch::Contains("'reduced'") &&
                        Catch::Contains("mixed_pressure, displacement"));
  CHECK_THROWS_AS(element_scheme(ElementKind::quad9, Formulation::displacement), InputError);
}

TEST_CASE("formulations go by their names") {
  for (const Formulation formulation :
       {Formulation::mixed_pressure, Formulation::displacement, Formulation::reduced}) {
    CHECK(formulation_from(name_of(formulation)) == formulation);
  }
  CHECK_THROWS_WITH(formulation_from("full"), Catch::Contains("'full'"));
}

}  // namespace flexneck::fe_modal
