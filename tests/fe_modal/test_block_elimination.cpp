// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <vector>

#include <Eigen/Dense>
#include <catch2/catch.hpp>

#include "fe_modal/algebra/block_elimination.h"

namespace flexneck::fe_modal {
namespace {

template <typename Scalar>
using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;

/// Lower triangle over a rectangle, with a diagonal that keeps solutions of the size of one. What
/// lies above the diagonal must not be read.
template <typename Scalar>
Matrix<Scalar> block_of(int rows, int columns) {
  Matrix<Scalar> block = Matrix<Scalar>::Random(rows, columns);
  block.diagonal().array() += Scalar(2 * columns);
  block.template triangularView<Eigen::StrictlyUpper>().setConstant(Scalar(1e30));
  return block;
}

template <typename Scalar, std::size_t lanes>
struct RightHandSides {
  std::vector<RowOf<Scalar, lanes>> rows;

  explicit RightHandSides(const Matrix<Scalar>& values)
      : rows(static_cast<std::size_t>(values.rows())) {
    map() = values;
  }
  auto map() {
    constexpr auto kColumns = static_cast<Eigen::Index>(lanes);
    using RowMajor = Eigen::Matrix<Scalar, Eigen::Dynamic, kColumns, Eigen::RowMajor>;
    return Eigen::Map<RowMajor>(rows.front().value, static_cast<Eigen::Index>(rows.size()),
                                kColumns);
  }
};

template <typename Scalar, std::size_t lanes>
void check_block(int rows, int columns, VectorRegisters registers) {
  CAPTURE(rows, columns, sizeof(Scalar), lanes, static_cast<int>(registers));
  const Matrix<Scalar> block = block_of<Scalar>(rows, columns);
  // The block lies among others, which the loops may fetch but not use.
  std::vector<Scalar> memory(static_cast<std::size_t>(3 * rows * columns), Scalar(1e30));
  std::copy_n(block.data(), block.size(), memory.data() + rows * columns);
  const FactorBlock<Scalar> view{memory.data() + rows * columns, rows, columns};
  const auto triangle = block.topRows(columns).template triangularView<Eigen::Lower>();
  const auto below = block.bottomRows(rows - columns);
  const Matrix<Scalar> given = Matrix<Scalar>::Random(rows, static_cast<Eigen::Index>(lanes));
  const Scalar tolerance = 100 * Eigen::NumTraits<Scalar>::epsilon();

  RightHandSides<Scalar, lanes> forward(given);
  forward.map().bottomRows(rows - columns).setZero();
  eliminate(view, forward.rows.data(), registers);
  const Matrix<Scalar> eliminated = triangle.solve(given.topRows(columns));
  CHECK((forward.map().topRows(columns) - eliminated).cwiseAbs().maxCoeff() <= tolerance);
  if (rows > columns) {
    CHECK((forward.map().bottomRows(rows - columns) + below * eliminated).cwiseAbs().maxCoeff() <=
          tolerance);
  }

  RightHandSides<Scalar, lanes> backward(given);
  substitute(view, backward.rows.data(), registers);
  const Matrix<Scalar> rest =
      given.topRows(columns) - below.transpose() * given.bottomRows(rows - columns);
  const Matrix<Scalar> substituted = triangle.transpose().solve(rest);
  CHECK((backward.map().topRows(columns) - substituted).cwiseAbs().maxCoeff() <= tolerance);
  CHECK(backward.map().bottomRows(rows - columns) == given.bottomRows(rows - columns));
}

}  // namespace

TEST_CASE("a block of a factor eliminates and substitutes as dense triangles, of any shape") {
  for (const VectorRegisters registers :
       {VectorRegisters::of_16_bytes, VectorRegisters::of_32_bytes, VectorRegisters::of_64_bytes}) {
    if (registers > widest_registers()) continue;
    for (int columns = 1; columns <= 14; ++columns) {
      for (const int more : {0, 1, 7, 8, 9, 30}) {
        check_block<double, 8>(columns + more, columns, registers);
        check_block<float, 8>(columns + more, columns, registers);
        check_block<float, 16>(columns + more, columns, registers);
      }
    }
  }
}

}  // namespace flexneck::fe_modal
