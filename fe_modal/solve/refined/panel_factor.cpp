// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/solve/refined/panel_factor.h"

#include <algorithm>
#include <cstddef>

#include "fe_modal/algebra/blas.h"
#include "fe_modal/algebra/cholesky_factor.h"
#include "geometry/foundation/error.h"

namespace flexneck::fe_modal {
namespace {

/// As many as block_elimination.cpp has in registers at a time.
constexpr int kPanelColumns = 6;

std::size_t size_of(const FactorBlock<float>& block) {
  return static_cast<std::size_t>(block.rows) * static_cast<std::size_t>(block.columns);
}

}  // namespace

PanelFactor::PanelFactor(Eigen::MatrixXd& matrix) : size_(static_cast<int>(matrix.rows())) {
  if (!factorise_in_place(DenseBlock<double>{matrix.data(), size_, size_, size_})) {
    throw ComputationError(kNotDefinite);
  }
  std::size_t count = 0;
  for (int first = 0; first < size_; first += kPanelColumns)
    count += size_of(panel_at(nullptr, first));
  values_.resize(count);
  float* place = values_.data();
  for (int first = 0; first < size_; first += kPanelColumns) {
    const int end = std::min(first + kPanelColumns, size_);
    for (int j = first; j < end; ++j) {
      const double* const column = matrix.col(j).data();
      place = std::transform(column + first, column + size_, place,
                             [](double value) { return static_cast<float>(value); });
    }
  }
}

FactorBlock<float> PanelFactor::panel_at(const float* values, int first) const {
  return {values, size_ - first, std::min(kPanelColumns, size_ - first)};
}

template <std::size_t lanes>
void PanelFactor::solve(RowOf<float, lanes>* x) const {
  const float* values = values_.data();
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

template void PanelFactor::solve(RowOf<float>*) const;
template void PanelFactor::solve(RowOf<float, kSinglesTogether>*) const;

}  // namespace flexneck::fe_modal
