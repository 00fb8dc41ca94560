// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/solve/refined/inner_block.h"

#include <Eigen/Cholesky>

#include "fe_modal/algebra/pivots.h"
#include "geometry/foundation/error.h"

namespace flexneck::fe_modal {
namespace {

/// The rows of a node in one group of columns.
template <typename Row>
struct NodeRows {
  Row of[kBlock];

  [[gnu::always_inline]] void load(const RowOf<float, Row::kLanes>* rows, std::size_t groups) {
    for (std::size_t a = 0; a < kBlock; ++a) of[a].load(rows[a * groups]);
  }
  [[gnu::always_inline]] void store(RowOf<float, Row::kLanes>* rows, std::size_t groups) const {
    for (std::size_t a = 0; a < kBlock; ++a) of[a].store(rows[a * groups]);
  }
};

}  // namespace

InnerBlock::InnerBlock(std::span<const std::int32_t> numbers, std::size_t place) {
  numbers_.reserve(numbers.size());
  numbers_.push_back(numbers[place]);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (i != place && numbers[i] >= 0) numbers_.push_back(numbers[i]);
  }
  entries_.resize(kBlock * kBlock * numbers_.size());
}

void InnerBlock::take_from(std::span<const std::int32_t> numbers, std::size_t place,
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
  float* entry = entries_.data();
  const auto take_rows = [&](Eigen::Index i) {
    for (Eigen::Index a = 0; a < 3; ++a) {
      for (Eigen::Index c = 0; c < 3; ++c) *entry++ = static_cast<float>(columns(a * width + i, c));
    }
  };
  take_rows(inner);
  for (Eigen::Index i = 0; i < width; ++i) {
    if (i != inner && numbers[static_cast<std::size_t>(i)] >= 0) take_rows(i);
  }
  element.noalias() -= columns * columns.transpose();
}

template <std::size_t lanes>
void InnerBlock::eliminate(std::size_t groups, std::span<RowOf<float, lanes>> rows) const {
  run_with(
      widest_registers(), [&]<std::size_t bytes>() __attribute__((always_inline)) {
        for (std::size_t group = 0; group < groups; ++group) {
          RowOf<float, lanes>* const first = rows.data() + group;
          NodeRows<RegisterRow<float, bytes, lanes>> own;
          own.load(first + first_row(groups, number()), groups);
          const float* entries = entries_.data();
          for (std::size_t a = 0; a < kBlock; ++a, entries += kBlock) {
            for (std::size_t c = 0; c < a; ++c) own.of[a].subtract(entries[c], own.of[c]);
            own.of[a].divide(entries[a]);
          }
          own.store(first + first_row(groups, number()), groups);
          for (const std::int32_t other : std::span(numbers_).subspan(1)) {
            NodeRows<RegisterRow<float, bytes, lanes>> next;
            next.load(first + first_row(groups, other), groups);
            for (std::size_t a = 0; a < kBlock; ++a, entries += kBlock) {
              for (std::size_t c = 0; c < kBlock; ++c) next.of[a].subtract(entries[c], own.of[c]);
            }
            next.store(first + first_row(groups, other), groups);
          }
        }
      });
}

template <std::size_t lanes>
void InnerBlock::substitute(std::size_t groups, std::span<const RowOf<float, lanes>> eliminated,
                            std::size_t count, std::span<RowOf<float, lanes>> sums) const {
  run_with(
      widest_registers(), [&]<std::size_t bytes>() __attribute__((always_inline)) {
        for (std::size_t group = 0; group < groups; ++group) {
          RowOf<float, lanes>* const first = sums.data() + group;
          NodeRows<RegisterRow<float, bytes, lanes>> own;
          own.load(eliminated.data() + group + first_row(groups, number()), groups);
          for (auto& row : own.of) row.multiply(static_cast<float>(count));
          const float* entries = entries_.data() + kBlock * kBlock;
          for (const std::int32_t other : std::span(numbers_).subspan(1)) {
            NodeRows<RegisterRow<float, bytes, lanes>> next;
            next.load(first + first_row(groups, other), groups);
            for (std::size_t a = 0; a < kBlock; ++a, entries += kBlock) {
              for (std::size_t c = 0; c < kBlock; ++c) own.of[c].subtract(entries[c], next.of[a]);
            }
          }
          for (std::size_t a = kBlock; a-- > 0;) {
            for (std::size_t c = a + 1; c < kBlock; ++c) {
              own.of[a].subtract(entries_[kBlock * c + a], own.of[c]);
            }
            own.of[a].divide(entries_[kBlock * a + a]);
          }
          own.store(first + first_row(groups, number()), groups);
        }
      });
}

template void InnerBlock::eliminate(std::size_t, std::span<RowOf<float>>) const;
template void InnerBlock::eliminate(std::size_t, std::span<RowOf<float, kSinglesTogether>>) const;
template void InnerBlock::substitute(std::size_t, std::span<const RowOf<float>>, std::size_t,
                                     std::span<RowOf<float>>) const;
template void InnerBlock::substitute(std::size_t, std::span<const RowOf<float, kSinglesTogether>>,
                                     std::size_t, std::span<RowOf<float, kSinglesTogether>>) const;

}  // namespace flexneck::fe_modal
