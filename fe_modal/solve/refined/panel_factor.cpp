// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/solve/refined/panel_factor.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "fe_modal/algebra/blas.h"
#include "fe_modal/algebra/cholesky_factor.h"
#include "geometry/foundation/error.h"

namespace flexneck::fe_modal {
namespace {

/// As many as block_elimination.cpp has in registers at a time.
constexpr int kPanelColumns = 6;

/// Of a column in its panel.
constexpr int first_row(int column) { return column / kPanelColumns * kPanelColumns; }

std::size_t size_of(const FactorBlock<float>& block) {
  return static_cast<std::size_t>(block.rows) * static_cast<std::size_t>(block.columns);
}

/// Packs numbers as multiples of a step.
/// @return the step
[[gnu::always_inline]] inline float packed(const double* numbers, int count, std::int16_t* values) {
  constexpr double kMost = std::numeric_limits<std::int16_t>::max();
  double largest = 0;
  for (int i = 0; i < count; ++i) largest = std::max(largest, std::abs(numbers[i]));
  const double per_step = largest > 0 ? kMost / largest : 0;
  for (int i = 0; i < count; ++i) {
    const double half = numbers[i] < 0 ? -0.5 : 0.5;
    values[i] = static_cast<std::int16_t>(static_cast<int>(per_step * numbers[i] + half));
  }
  return static_cast<float>(largest / kMost);
}

}  // namespace

PanelFactor::PanelFactor(std::size_t size)
    : size_(static_cast<int>(size)),
      diagonal_(size),
      steps_(size),
      values_(size < 2 ? 0 : (size * size - size) / 2) {}

void PanelFactor::factorise(Eigen::MatrixXd& matrix) {
  if (!factorise_in_place(DenseBlock<double>{matrix.data(), size_, size_, size_})) {
    throw ComputationError(kNotDefinite);
  }
  run_with(
      widest_registers(), [&]<std::size_t /*bytes*/>() __attribute__((always_inline)) {
        std::int16_t* values = values_.data();
        for (int j = 0; j < size_; ++j) {
          const double* const column = matrix.data() + j * matrix.rows();
          const int below = size_ - j - 1;
          diagonal_[static_cast<std::size_t>(j)] = static_cast<float>(column[j]);
          steps_[static_cast<std::size_t>(j)] = packed(column + j + 1, below, values);
          values += below;
        }
      });
}

FactorBlock<float> PanelFactor::panel_at(const float* values, int first) const {
  return {values, size_ - first, std::min(kPanelColumns, size_ - first)};
}

void PanelFactor::unpack(std::vector<float>& entries) const {
  std::size_t count = 0;
  for (int first = 0; first < size_; first += kPanelColumns)
    count += size_of(panel_at(nullptr, first));
  entries.resize(count);
  const std::int16_t* given = values_.data();
  float* place = entries.data();
  run_with(
      widest_registers(), [&]<std::size_t /*bytes*/>() __attribute__((always_inline)) {
        for (int j = 0; j < size_; ++j) {
          const float step = steps_[static_cast<std::size_t>(j)];
          for (int i = first_row(j); i < j; ++i) *place++ = 0;
          *place++ = diagonal_[static_cast<std::size_t>(j)];
          const int below = size_ - j - 1;
          for (int i = 0; i < below; ++i) place[i] = step * static_cast<float>(given[i]);
          place += below;
          given += below;
        }
      });
}

template <std::size_t lanes>
void PanelFactor::solve(std::span<const float> entries, RowOf<float, lanes>* x) const {
  const float* values = entries.data();
  int first = 0;
  for (; first < size_; first += kPanelColumns) {
    const FactorBlock<float> panel = panel_at(values, first);
    eliminate(panel, x + first);
    values += size_of(panel);
  }
  while (first > 0) {
    first -= kPanelColumns;
    values -= size_of(panel_at(values, first));
    substitute(panel_at(values, first), x + first);
  }
}

template void PanelFactor::solve(std::span<const float>, RowOf<float>*) const;
template void PanelFactor::solve(std::span<const float>, RowOf<float, kSinglesTogether>*) const;

}  // namespace flexneck::fe_modal
