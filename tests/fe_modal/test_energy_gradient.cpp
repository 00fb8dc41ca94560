// SPDX-License-Identifier: GPL-3.0-or-later
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "fe_modal/element/energy_gradient.h"
#include "mesher/mesh/shape_functions.h"
#include "tests/support/block_mesh.h"
#include "tests/support/element_choices.h"
#include "tests/support/finite_differences.h"

namespace flexneck::fe_modal {
namespace {

using mesher::ElementKind;

/// Relative error of differences of order 6 with steps of a hundredth.
constexpr double kDifferences = 1e-8;
constexpr double kLambda = 3e5;

/// A distorted element of the size of a centimetre.
Eigen::Matrix3Xd element_nodes(ElementKind kind) {
  const auto reference = mesher::reference_nodes(kind);
  Eigen::Matrix3Xd nodes(3, static_cast<Eigen::Index>(reference.size()));
  for (std::size_t i = 0; i < reference.size(); ++i) {
    const Eigen::Vector3d p(reference[i].data());
    nodes.col(static_cast<Eigen::Index>(i)) = 0.01 * testing::distorted(0.5 * (p.array() + 1));
  }
  return nodes;
}

/// Arbitrary numbers, the same in every run.
Eigen::MatrixXd numbers(Eigen::Index rows, Eigen::Index columns, double phase) {
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [phase](Eigen::Index i, Eigen::Index j) {
    return std::sin(phase + 1.7 * static_cast<double>(i) + 2.9 * static_cast<double>(j));
  });
}

/// Forms u^T (K - lambda M) w and the mass, from the assembled matrices.
Eigen::Vector3d energies(const ElementScheme& scheme, const Eigen::Matrix3Xd& nodes_m,
                         const mesher::Material& material, const Eigen::MatrixXd& fields) {
  ElementMatrices element;
  ElementKernel(scheme).compute(nodes_m, material, element);
  const Eigen::Index n = nodes_m.cols();
  Eigen::MatrixXd matrix = element.stiffness;
  for (Eigen::Index a = 0; a < 3; ++a) matrix.block(a * n, a * n, n, n) -= kLambda * element.mass;
  return {fields.col(0).dot(matrix * fields.col(0)), fields.col(0).dot(matrix * fields.col(1)),
          element.mass.sum()};
}

void check_same(const Eigen::Vector3d& found, const Eigen::Vector3d& expected,
                const Eigen::Vector3d& scale) {
  for (Eigen::Index k = 0; k < 3; ++k) {
    CHECK(std::abs(found[k] - expected[k]) < kDifferences * scale[k]);
  }
}

}  // namespace

TEST_CASE("energies of every element change as the gradient says") {
  for (const ElementKind kind : kVolumes) {
    for (const Formulation formulation : kFormulations) {
      if (!offered(kind, formulation)) continue;
      INFO(mesher::name_of(kind) << ", " << name_of(formulation));
      const ElementScheme& scheme = element_scheme(kind, formulation);
      const Eigen::Matrix3Xd nodes = element_nodes(kind);
      const Eigen::Index n = nodes.cols();
      const Eigen::MatrixXd fields = numbers(3 * n, 2, 0.3);
      ElementGradient found;
      EnergyGradient(scheme, {{0, 0, kLambda}, {0, 1, kLambda}})
          .compute(nodes, kRubber, fields, found);
      const Eigen::Vector3d scale =
          energies(scheme, nodes, kRubber, fields).cwiseAbs().maxCoeff() *
              Eigen::Vector3d(1, 1, 0) +
          Eigen::Vector3d(0, 0, energies(scheme, nodes, kRubber, fields)[2]);

      // The element changes by the order of its own size per unit of t.
      const Eigen::Matrix3Xd velocity = 0.01 * numbers(3, n, 1.1);
      const auto moved = [&](double t) {
        return energies(scheme, nodes + t * velocity, kRubber, fields);
      };
      Eigen::Vector3d along;
      for (Eigen::Index k = 0; k < 2; ++k) {
        along[k] = 0;
        for (Eigen::Index a = 0; a < 3; ++a) {
          along[k] += found.by_nodes.row(2 * a + k).dot(velocity.row(a));
        }
      }
      along[2] = found.mass_by_nodes.cwiseProduct(velocity).sum();
      check_same(along, testing::first_derivative(moved, 2e-3), 10 * scale);

      const auto with = [&](double mesher::Material::*constant, double step) {
        return testing::first_derivative(
            [&](double t) {
              mesher::Material material = kRubber;
              material.*constant += step * t;
              return energies(scheme, nodes, material, fields);
            },
            1e-2);
      };
      const double density = kRubber.density_kg_m3;
      const auto by = [&](Eigen::Index constant, double step, double of_mass) {
        return Eigen::Vector3d(step * found.by_material(0, constant),
                               step * found.by_material(1, constant), of_mass);
      };
      const double young = kRubber.youngs_modulus_Pa;
      check_same(by(0, young, 0), with(&mesher::Material::youngs_modulus_Pa, young), scale);
      check_same(by(1, 0.01, 0), with(&mesher::Material::poissons_ratio, 0.01), scale);
      check_same(by(2, density, density * found.volume_m3),
                 with(&mesher::Material::density_kg_m3, density), scale);
    }
  }
}

}  // namespace flexneck::fe_modal
