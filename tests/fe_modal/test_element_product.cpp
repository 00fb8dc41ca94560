// SPDX-License-Identifier: GPL-3.0-or-later
#include <vector>

#include <catch2/catch.hpp>

#include "fe_modal/algebra/packed_matrix.h"
#include "fe_modal/algebra/symmetric_sum.h"
#include "fe_modal/element/element_kernel.h"
#include "fe_modal/element/element_product.h"
#include "geometry/foundation/error.h"
#include "mesher/mesh/shape_functions.h"
#include "tests/support/block_mesh.h"
#include "tests/support/element_choices.h"

namespace flexneck::fe_modal {
namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

std::vector<VectorRegisters> widths() {
  std::vector<VectorRegisters> result;
  for (const VectorRegisters registers :
       {VectorRegisters::of_16_bytes, VectorRegisters::of_32_bytes, VectorRegisters::of_64_bytes}) {
    if (registers <= widest_registers()) result.push_back(registers);
  }
  return result;
}

Eigen::Matrix3Xd distorted_nodes(mesher::ElementKind kind) {
  const auto reference = mesher::reference_nodes(kind);
  Eigen::Matrix3Xd nodes(3, static_cast<Eigen::Index>(reference.size()));
  for (std::size_t i = 0; i < reference.size(); ++i) {
    const Eigen::Vector3d place(reference[i].data());
    nodes.col(static_cast<Eigen::Index>(i)) = testing::distorted(0.5 * (place.array() + 1));
  }
  return nodes;
}

/// Columns in rows of eight, zeros behind the last.
std::vector<RowOf<double>> rows_of(const Eigen::MatrixXd& columns) {
  const std::size_t groups =
      (static_cast<std::size_t>(columns.cols()) + kColumnsTogether - 1) / kColumnsTogether;
  std::vector<RowOf<double>> rows(static_cast<std::size_t>(columns.rows()) * groups);
  Eigen::Map<RowMajor>(rows.front().value, columns.rows(),
                       static_cast<Eigen::Index>(groups * kColumnsTogether))
      .leftCols(columns.cols()) = columns;
  return rows;
}

Eigen::MatrixXd columns_of(const std::vector<RowOf<double>>& rows, Eigen::Index row_count,
                           Eigen::Index column_count) {
  return Eigen::Map<const RowMajor>(
             rows.front().value, row_count,
             static_cast<Eigen::Index>(rows.size() * kColumnsTogether) / row_count)
      .leftCols(column_count);
}

/// Degree of freedom a n + i of k fields, (3n, k), as (n, 3k) with column a k + c.
Eigen::MatrixXd by_nodes(const Eigen::MatrixXd& fields) {
  const Eigen::Index n = fields.rows() / 3;
  Eigen::MatrixXd result(n, 3 * fields.cols());
  for (Eigen::Index a = 0; a < 3; ++a) {
    result.middleCols(a * fields.cols(), fields.cols()) = fields.middleRows(a * n, n);
  }
  return result;
}

double relative(const Eigen::MatrixXd& found, const Eigen::MatrixXd& expected) {
  return (found - expected).cwiseAbs().maxCoeff() / expected.cwiseAbs().maxCoeff();
}

}  // namespace

TEST_CASE("fields times an element are those times its matrices, in every kind and width") {
  for (const mesher::ElementKind kind : kVolumes) {
    for (const Formulation formulation : kFormulations) {
      if (!offered(kind, formulation)) continue;
      const ElementScheme& scheme = element_scheme(kind, formulation);
      const Eigen::Matrix3Xd nodes = distorted_nodes(kind);
      const Eigen::Index n = nodes.cols();
      ElementMatrices matrices;
      ElementKernel(scheme).compute(nodes, kRubber, matrices);
      for (const VectorRegisters registers : widths()) {
        for (const Eigen::Index k : {1, 3, 10, 17}) {
          CAPTURE(mesher::name_of(kind), name_of(formulation), static_cast<int>(registers), k);
          const Eigen::MatrixXd fields = Eigen::MatrixXd::Random(3 * n, k);
          const std::vector<RowOf<double>> rows = rows_of(by_nodes(fields));
          std::vector<RowOf<double>> forces(rows.size());
          std::vector<RowOf<double>> momenta(rows.size());
          ElementProduct product(scheme, registers);
          product.apply(nodes, kRubber, rows.data(), static_cast<std::size_t>(k), forces.data(),
                        momenta.data());
          CHECK(relative(columns_of(forces, n, 3 * k), by_nodes(matrices.stiffness * fields)) <
                1e-13);
          CHECK(relative(columns_of(momenta, n, 3 * k), matrices.mass * by_nodes(fields)) < 1e-13);
          const std::vector<RowOf<double>> first = forces;
          product.apply(nodes, kRubber, rows.data(), static_cast<std::size_t>(k), forces.data(),
                        nullptr);
          CHECK(columns_of(forces, n, 3 * k) == columns_of(first, n, 3 * k));
        }
      }
    }
  }
}

TEST_CASE("a product with an inverted element is refused") {
  const auto kind = mesher::ElementKind::hex27;
  Eigen::Matrix3Xd nodes = distorted_nodes(kind);
  nodes.row(0) *= -1;
  const std::vector<RowOf<double>> rows(static_cast<std::size_t>(nodes.cols()));
  std::vector<RowOf<double>> forces(rows.size());
  CHECK_THROWS_AS(ElementProduct(element_scheme(kind, Formulation::mixed_pressure))
                      .apply(nodes, kRubber, rows.data(), 1, forces.data(), nullptr),
                  ComputationError);
}

TEST_CASE("a packed matrix multiplies like a plain one, of any shape and in every width") {
  for (const VectorRegisters registers : widths()) {
    for (const Eigen::Index rows : {1, 2, 3, 4, 10, 27, 32}) {
      for (const Eigen::Index columns : {1, 8, 24, 30, 56}) {
        CAPTURE(static_cast<int>(registers), rows, columns);
        const Eigen::MatrixXd matrix = Eigen::MatrixXd::Random(rows, 7);
        const Eigen::MatrixXd x = Eigen::MatrixXd::Random(7, columns);
        const std::vector<RowOf<double>> given = rows_of(x);
        const std::size_t groups = given.size() / 7;
        std::vector<RowOf<double>> result(static_cast<std::size_t>(rows) * groups);
        PackedMatrix(matrix).multiply(given.data(), groups, result.data(), registers);
        CHECK(relative(columns_of(result, rows, columns), matrix * x) < 1e-14);
      }
    }
  }
}

TEST_CASE("a sum of symmetric matrices is that of plain ones, in every width") {
  for (const VectorRegisters registers : widths()) {
    for (const Eigen::Index size : {1, 3, 8, 20}) {
      CAPTURE(static_cast<int>(registers), size);
      std::vector<Eigen::MatrixXd> terms;
      for (int k = 0; k < 5; ++k) {
        const Eigen::MatrixXd any = Eigen::MatrixXd::Random(size, size);
        terms.emplace_back(any + any.transpose());
      }
      SymmetricSum sum(terms);
      for (int time = 0; time < 2; ++time) {
        const Eigen::VectorXd factors = Eigen::VectorXd::Random(5);
        Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(size, size);
        for (int k = 0; k < 5; ++k) expected += factors(k) * terms[static_cast<std::size_t>(k)];
        const std::vector<RowOf<double>> given = rows_of(Eigen::MatrixXd::Identity(size, size));
        std::vector<RowOf<double>> result(given.size());
        sum.with(factors, registers)
            .multiply(given.data(), given.size() / static_cast<std::size_t>(size), result.data());
        CHECK(relative(columns_of(result, size, size), expected) < 1e-14);
      }
    }
  }
}

}  // namespace flexneck::fe_modal
