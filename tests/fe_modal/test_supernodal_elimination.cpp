// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/QR>
#include <catch2/catch.hpp>

#include "fe_modal/algebra/block_product.h"
#include "fe_modal/algebra/cholesky_factor.h"
#include "fe_modal/algebra/cholmod_handles.h"
#include "fe_modal/algebra/inertia_count.h"
#include "fe_modal/algebra/operator_matrix.h"
#include "fe_modal/algebra/signed_cholesky.h"
#include "fe_modal/algebra/supernodal_factor.h"
#include "fe_modal/solve/refined/panel_factor.h"
#include "fe_modal/system/assembly.h"
#include "geometry/foundation/error.h"
#include "tests/fe_modal/dense.h"
#include "tests/support/block_mesh.h"
#include "tests/support/dense_solvers.h"
#include "tests/support/element_choices.h"

namespace flexneck::fe_modal {
namespace {

SystemMatrices clamped(std::array<int, 3> divisions) {
  const mesher::Mesh mesh = testing::box(divisions, {0.1, 0.1, 0.1}, kSteel).make();
  return assemble(mesh, DofMap(mesh, mesh.node_set("bottom").nodes));
}

/// So many plates that have nothing in common but the last node of each.
SystemMatrices plates_with_a_common_node(std::int32_t count) {
  const mesher::Mesh plate = testing::box({7, 7, 1}, {0.1, 0.1, 0.1}, kSteel).make();
  const auto last = static_cast<std::int32_t>(plate.nodes.size()) - 1;
  mesher::Mesh mesh = plate;
  std::vector<std::int32_t> fixed = plate.node_set("bottom").nodes;
  for (std::int32_t k = 1; k < count; ++k) {
    const auto copy_of = [&](std::int32_t node) {
      return node == last ? last : k * last + 1 + node;
    };
    mesh.nodes.insert(mesh.nodes.end(), plate.nodes.begin(), plate.nodes.end() - 1);
    for (const std::int32_t node : plate.blocks.front().nodes) {
      mesh.blocks.front().nodes.push_back(copy_of(node));
    }
    for (const std::int32_t node : plate.node_set("bottom").nodes) fixed.push_back(copy_of(node));
  }
  return assemble(mesh, DofMap(mesh, fixed));
}

std::optional<Eigen::Index> count(const SymmetricMatrix& matrix) {
  return count_without_pivoting(matrix.get(), matrix.get(), CholmodOrder::best, {}, {}, 1);
}

/// By a factor in single precision alone.
std::optional<Eigen::Index> count_in_single(const SymmetricMatrix& matrix,
                                            const KnownVectors& known) {
  const cholmod_sparse view = cholmod_view(matrix.get());
  CholmodAnalysis analysis(view, CholmodOrder::best, {});
  const SupernodalFactor<float> factor(analysis, 1, {}, Pivots::of_any_sign);
  const auto inverse = [&](const Eigen::MatrixXd& x) { return factor.solution(x, 1); };
  return count_by_factor({}, matrix.get(), {inverse, factor.negative_pivots()}, known);
}

/// A symmetric matrix with about half of its eigenvalues below zero.
Eigen::MatrixXd indefinite(int size) {
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Random(size, size);
  matrix = (matrix + matrix.transpose()).eval();
  for (int k = 0; k < size; ++k) matrix(k, k) += k % 2 == 0 ? 3.0 * size : -3.0 * size;
  return matrix;
}

/// A matrix, and factors of others that have all its eigenvectors and all its eigenvalues but one.
class Spectrum {
 public:
  static constexpr Eigen::Index kSize = 40;
  static constexpr Eigen::Index kOther = kSize / 3;

  Spectrum()
      : vectors_(Eigen::HouseholderQR<Eigen::MatrixXd>(Eigen::MatrixXd::Random(kSize, kSize))
                     .householderQ()),
        values_(Eigen::VectorXd::LinSpaced(kSize, -3, 7)),
        matrix_(vectors_ * values_.asDiagonal() * vectors_.transpose()) {}

  Eigen::Index negative() const { return (values_.array() < 0).count(); }
  /// So many eigenvectors, the one in the middle that of the eigenvalue which factors have not.
  Eigen::MatrixXd around(Eigen::Index count) const {
    return vectors_.middleCols(kOther - count / 2, count);
  }
  /// @param ratio the factor's eigenvalue over the matrix's: refinement leaves |1 - 1 / ratio| of
  /// an error
  /// @param known of unit mass; columns, or nothing
  std::optional<Eigen::Index> count_with(double ratio, const Eigen::MatrixXd& known) const {
    Eigen::VectorXd values = values_;
    values[kOther] *= ratio;
    const Eigen::MatrixXd inverse =
        vectors_ * values.cwiseInverse().asDiagonal() * vectors_.transpose();
    const OperatorMatrix product(kSize, [&](const Eigen::MatrixXd& x) { return matrix_ * x; });
    const SignedFactor factor{[&](const Eigen::MatrixXd& x) { return inverse * x; },
                              (values.array() < 0).count()};
    return count_by_factor({}, product.get(), factor, {known, known});
  }

 private:
  Eigen::MatrixXd vectors_;
  Eigen::VectorXd values_;
  Eigen::MatrixXd matrix_;
};

}  // namespace

TEST_CASE("supernodes that threads divide have the same factor, to the last bit, and solve") {
  // Layer after layer of the plate: its last supernode has two layers.
  const SystemMatrices system = clamped({9, 9, 2});
  std::vector<std::int32_t> layers(static_cast<std::size_t>(system.graph.node_count()));
  std::iota(layers.begin(), layers.end(), 0);
  const CholeskyFactor alone(system.stiffness.get(), 0, layers, 1);
  const CholeskyFactor together(system.stiffness.get(), 0, layers, 3);
  constexpr double kWidth = 3 * 2 * 19 * 19;
  REQUIRE(alone.nonzeros() > kWidth * kWidth / 2);
  const Eigen::MatrixXd truth = Eigen::MatrixXd::Random(3 * system.graph.node_count(), 2);
  const Eigen::MatrixXd forces = SymmetricProduct(system.stiffness)(truth);
  const Eigen::MatrixXd solution = alone.solve(forces);
  CHECK((solution - truth).norm() < 1e-9 * truth.norm());
  CHECK(together.solve(forces) == solution);
}

TEST_CASE("a supernode whose last columns alone are in the top of the tree solves") {
  // Each of seven plates has more than an eighth of the factor, its tree without the last columns
  // of the last supernode has less.
  const SystemMatrices system = plates_with_a_common_node(7);
  constexpr std::int32_t kFreeNodes = 2 * 15 * 15;
  std::vector<std::int32_t> order(static_cast<std::size_t>(system.graph.node_count()));
  std::iota(order.begin(), order.end(), 0);
  std::rotate(order.begin() + kFreeNodes - 1, order.begin() + kFreeNodes, order.end());
  const CholeskyFactor factor(system.stiffness.get(), 0, order);
  const Eigen::MatrixXd truth = Eigen::MatrixXd::Random(3 * system.graph.node_count(), 2);
  const Eigen::MatrixXd solution = factor.solve(SymmetricProduct(system.stiffness)(truth));
  CHECK((solution - truth).norm() < 1e-9 * truth.norm());
}

TEST_CASE("the factor of a singular matrix fails or is in doubt, that of a sound one is not") {
  for (const int layers : {1, 2, 3, 5}) {
    const mesher::Mesh mesh = testing::box({1, 2, layers}, {0.1, 0.1, 0.3}, kSteel).make();
    const auto is_trusted = [&](const std::vector<std::int32_t>& fixed) {
      const SystemMatrices system = assemble(mesh, DofMap(mesh, fixed));
      try {
        return !CholeskyFactor(system.stiffness.get(), 0).is_doubtful();
      } catch (const ComputationError&) {
        return false;
      }
    };
    CHECK(is_trusted(mesh.node_set("bottom").nodes));
    CHECK_FALSE(is_trusted({}));
  }
}

TEST_CASE("pivots without pivoting count all negative eigenvalues or nothing") {
  const SystemMatrices system = clamped({2, 2, 2});
  const Eigen::VectorXd values =
      testing::dense_pairs(dense(system.stiffness.get()), dense(system.mass.get())).values;
  int counted = 0;
  for (Eigen::Index k = 1; k < values.size(); k += 3) {
    if (values[k] < values[k - 1] * (1 + 1e-6)) continue;
    const double shift = (values[k - 1] + values[k]) / 2;
    const std::optional<Eigen::Index> found = count(shifted_stiffness(system, shift));
    if (k < 30) CHECK(found);  // above, errors may grow too much
    if (!found) continue;
    CHECK(*found == k);
    ++counted;
  }
  CHECK(counted > 15);
}

TEST_CASE("a factor in single precision counts modes but where one is near that is not known") {
  const SystemMatrices system = clamped({3, 3, 2});
  const testing::DensePairs pairs =
      testing::dense_pairs(dense(system.stiffness.get()), dense(system.mass.get()));
  const Eigen::VectorXd& values = pairs.values;
  const Eigen::MatrixXd vectors = pairs.vectors.leftCols(12);
  const KnownVectors known{vectors, block_product(system.mass.get(), vectors)};
  for (const Eigen::Index k : {0, 2, 5, 9}) {
    for (const double beside : {-1e-3, -1e-5, -1e-7, -1e-9, 1e-9, 1e-7, 1e-5, 1e-3}) {
      INFO("eigenvalue " << k << ", beside it by " << beside);
      const double sigma = values[k] * (1 + beside);
      const Eigen::Index below = (values.array() < sigma).count();
      const SymmetricMatrix shifted = shifted_stiffness(system, sigma);
      CHECK(count(shifted) == below);
      const std::optional<Eigen::Index> in_single = count_in_single(shifted, {});
      CHECK(in_single.value_or(below) == below);
      if (std::abs(beside) == 1e-3) CHECK(in_single);
      if (std::abs(beside) == 1e-9) CHECK_FALSE(in_single);
      CHECK(count_in_single(shifted, known) == below);
    }
  }
}

TEST_CASE("a factor counts for a matrix that it is near to, of others nothing is said") {
  const Spectrum spectrum;
  const auto is_counted = [&](double ratio) {
    const std::optional<Eigen::Index> counted = spectrum.count_with(ratio, {});
    if (counted) CHECK(*counted == spectrum.negative());
    return counted.has_value();
  };
  CHECK(is_counted(1));
  CHECK(is_counted(0.9));
  CHECK(is_counted(1.1));
  CHECK(is_counted(0.56));
  CHECK_FALSE(is_counted(0.51));
  CHECK_FALSE(is_counted(0.4));
  CHECK_FALSE(is_counted(-1));
  CHECK_FALSE(is_counted(-1e-6));
  CHECK_FALSE(is_counted(-1e6));
}

TEST_CASE("with vectors that are known the count is that of the matrix, whatever the factor has") {
  const Spectrum spectrum;
  const Eigen::MatrixXd random = Eigen::MatrixXd::Random(Spectrum::kSize, 3);
  for (const double ratio : {0.51, 0.4, 1e-2, -1e-2, -1.0, -100.0}) {
    INFO("the factor has one eigenvalue " << ratio << " times");
    for (const double wrong : {0.0, 1e-9, 1e-4}) {
      const Eigen::MatrixXd known = spectrum.around(3) + wrong * random;
      const std::optional<Eigen::Index> counted = spectrum.count_with(ratio, known);
      if (wrong < 1e-6) CHECK(counted);
      CHECK(counted.value_or(spectrum.negative()) == spectrum.negative());
    }
    // That one is not among them, or not alone.
    CHECK_FALSE(spectrum.count_with(ratio, spectrum.around(3).leftCols(1)));
    CHECK_FALSE(spectrum.count_with(ratio, random));
    const Eigen::MatrixXd twice = spectrum.around(3)(Eigen::all, {0, 1, 1});
    CHECK_FALSE(spectrum.count_with(ratio, twice));
  }
  CHECK(spectrum.count_with(0.9, random).value_or(spectrum.negative()) == spectrum.negative());
}

TEST_CASE("a pivot that is zero counts nothing") {
  const SystemMatrices system = clamped({1, 1, 1});
  SymmetricMatrix matrix = system.stiffness.clone();
  std::fill(matrix.values().begin(), matrix.values().end(), 0.0);
  CHECK_FALSE(count(matrix));
}

TEST_CASE("a signed factor is that of the matrix and has its inertia") {
  for (const int size : {1, 2, 16, 17, 33, 100}) {
    const Eigen::MatrixXd matrix = indefinite(size);
    Eigen::MatrixXd factor = matrix;
    Eigen::MatrixXd workspace(size, size);
    std::vector<double> signs(static_cast<std::size_t>(size));
    const auto view = [&](Eigen::MatrixXd& of) {
      return DenseBlock<double>{of.data(), size, size, size};
    };
    REQUIRE(factorise_with_signs(view(factor), std::span(signs), view(workspace)));
    const Eigen::MatrixXd lower = factor.triangularView<Eigen::Lower>();
    const Eigen::Map<const Eigen::VectorXd> diagonal(signs.data(), size);
    CHECK((lower * diagonal.asDiagonal() * lower.transpose() - matrix).norm() <
          1e-13 * matrix.norm());
    CHECK((diagonal.array() < 0).count() ==
          (testing::symmetric_eigenvalues(matrix).array() < 0).count());
  }
}

TEST_CASE("a factor in panels solves as one whose columns are rounded to 16 bits does") {
  for (const int size : {1, 5, 6, 7, 12, 81}) {
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Random(size, size);
    matrix = (matrix * matrix.transpose() + size * Eigen::MatrixXd::Identity(size, size)).eval();
    // Stiffnesses from one to ten thousand, as of rubber beside steel.
    const Eigen::VectorXd scale = Eigen::VectorXd::LinSpaced(size, 1, 100);
    matrix = (scale.asDiagonal() * matrix * scale.asDiagonal()).eval();
    const Eigen::MatrixXd forces = scale.asDiagonal() * Eigen::MatrixXd::Random(size, 8);
    const Eigen::MatrixXd exact = testing::symmetric_solution(matrix, forces);
    Eigen::MatrixXd rounded = Eigen::LLT<Eigen::MatrixXd>(matrix).matrixL();
    for (Eigen::Index j = 0; j + 1 < size; ++j) {
      auto below = rounded.col(j).tail(size - j - 1);
      const double step = below.cwiseAbs().maxCoeff() / 32767;
      below = (below / step).array().round() * step;
    }
    const Eigen::MatrixXd expected =
        testing::symmetric_solution(rounded * rounded.transpose(), forces);
    PanelFactor factor(static_cast<std::size_t>(size));
    factor.factorise(matrix);
    std::vector<RowOf<float>> x(static_cast<std::size_t>(size));
    using RowMajor = Eigen::Matrix<float, Eigen::Dynamic, 8, Eigen::RowMajor>;
    Eigen::Map<RowMajor> columns(x.front().value, size, 8);
    columns = forces.cast<float>();
    std::vector<float> entries;
    factor.unpack(entries);
    factor.solve(entries, x.data());
    const Eigen::MatrixXd found = scale.asDiagonal() * columns.cast<double>();
    CHECK((found - scale.asDiagonal() * expected).norm() < 1e-6 * found.norm());
    CHECK((found - scale.asDiagonal() * exact).norm() < 1e-4 * found.norm());
  }
  // The first column has 1 on its diagonal and a million below it.
  Eigen::MatrixXd steep(2, 2);
  steep << 1, 1e6, 1e6, 1.01e12;
  PanelFactor factor(2);
  factor.factorise(steep);
  std::vector<float> entries;
  factor.unpack(entries);
  CHECK(entries[0] == 1);
  CHECK(entries[1] == Approx(1e6));
  Eigen::MatrixXd negative = -Eigen::MatrixXd::Identity(3, 3);
  CHECK_THROWS_AS(PanelFactor(3).factorise(negative), ComputationError);
}

}  // namespace flexneck::fe_modal
