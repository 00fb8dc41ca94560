// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/solve/refined/inner_block.h"

#include <algorithm>

#include <Eigen/Cholesky>

#include "fe_modal/algebra/block_elimination.h"
#include "fe_modal/algebra/pivots.h"
#include "geometry/foundation/error.h"

namespace flexneck::fe_modal {
namespace {

constexpr std::size_t kNode = 3;

FactorBlock<float> factor_block(const std::vector<float>& columns) {
  return {columns.data(), static_cast<int>(columns.size() / kNode), static_cast<int>(kNode)};
}

std::size_t row_of(std::size_t groups, std::int32_t number, std::size_t direction) {
  return groups * (kNode * static_cast<std::size_t>(number) + direction);
}

}  // namespace

InnerBlock::InnerBlock(std::span<const std::int32_t> numbers, std::size_t place,
                       Eigen::MatrixXd& element) {
  const auto width = static_cast<Eigen::Index>(numbers.size());
  const auto rows_of = [&](Eigen::Index i) { return Eigen::seqN(i, 3, width); };
  const auto inner = static_cast<Eigen::Index>(place);
  // Dependent degrees of freedom have no stiffness.
  for (Eigen::Index row = inner; row < element.rows(); row += width) {
    if (element(row, row) == 0) element(row, row) = 1;
  }
  const Eigen::Matrix3d own = element(rows_of(inner), rows_of(inner));
  const Eigen::LLT<Eigen::Matrix3d> factor(own);
  if (factor.info() != Eigen::Success) throw ComputationError(kNotDefinite);
  Eigen::MatrixX3d columns = element(Eigen::all, rows_of(inner));
  factor.matrixU().solveInPlace<Eigen::OnTheRight>(columns);
  std::vector<Eigen::Index> places = {inner};
  for (Eigen::Index i = 0; i < width; ++i) {
    if (i != inner && numbers[static_cast<std::size_t>(i)] >= 0) places.push_back(i);
  }
  numbers_.reserve(places.size());
  columns_.reserve(9 * places.size());
  for (const Eigen::Index i : places) numbers_.push_back(numbers[static_cast<std::size_t>(i)]);
  for (Eigen::Index column = 0; column < 3; ++column) {
    for (const Eigen::Index i : places) {
      for (Eigen::Index a = 0; a < 3; ++a) {
        columns_.push_back(static_cast<float>(columns(a * width + i, column)));
      }
    }
  }
  element.noalias() -= columns * columns.transpose();
}

template <std::size_t lanes>
void InnerBlock::eliminate(std::size_t groups, std::span<RowOf<float, lanes>> rows) const {
  std::vector<RowOf<float, lanes>> own(kNode * numbers_.size());
  for (std::size_t group = 0; group < groups; ++group) {
    for (std::size_t a = 0; a < kNode; ++a) own[a] = rows[row_of(groups, number(), a) + group];
    std::fill(own.begin() + kNode, own.end(), RowOf<float, lanes>{});
    fe_modal::eliminate(factor_block(columns_), own.data());
    for (std::size_t i = 0; i < own.size(); ++i) {
      RowOf<float, lanes>& row = rows[row_of(groups, numbers_[i / kNode], i % kNode) + group];
      if (i < kNode)
        row = own[i];
      else
        for (std::size_t c = 0; c < lanes; ++c) row.value[c] += own[i].value[c];
    }
  }
}

template <std::size_t lanes>
void InnerBlock::substitute(std::size_t groups, std::span<const RowOf<float, lanes>> eliminated,
                            std::size_t count, std::span<RowOf<float, lanes>> sums) const {
  std::vector<RowOf<float, lanes>> own(kNode * numbers_.size());
  for (std::size_t group = 0; group < groups; ++group) {
    for (std::size_t i = 0; i < own.size(); ++i) {
      own[i] = sums[row_of(groups, numbers_[i / kNode], i % kNode) + group];
    }
    for (std::size_t a = 0; a < kNode; ++a) {
      const RowOf<float, lanes>& row = eliminated[row_of(groups, number(), a) + group];
      for (std::size_t c = 0; c < lanes; ++c)
        own[a].value[c] = static_cast<float>(count) * row.value[c];
    }
    fe_modal::substitute(factor_block(columns_), own.data());
    for (std::size_t a = 0; a < kNode; ++a) sums[row_of(groups, number(), a) + group] = own[a];
  }
}

template void InnerBlock::eliminate(std::size_t, std::span<RowOf<float>>) const;
template void InnerBlock::eliminate(std::size_t, std::span<RowOf<float, kSinglesTogether>>) const;
template void InnerBlock::substitute(std::size_t, std::span<const RowOf<float>>, std::size_t,
                                     std::span<RowOf<float>>) const;
template void InnerBlock::substitute(std::size_t, std::span<const RowOf<float, kSinglesTogether>>,
                                     std::size_t, std::span<RowOf<float, kSinglesTogether>>) const;

}  // namespace flexneck::fe_modal
