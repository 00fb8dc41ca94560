// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <span>

#include "fe_modal/algebra/blas.h"

namespace flexneck::fe_modal {

/// Multiplies columns by these.
template <typename Scalar>
void turn_columns(const DenseBlock<Scalar>& block, std::span<const Scalar> signs) {
  for (int j = 0; j < block.columns; ++j) {
    if (signs[static_cast<std::size_t>(j)] > 0) continue;
    std::transform(block.column(j), block.column(j) + block.rows, block.column(j),
                   [](Scalar value) { return -value; });
  }
}

/// The lower triangle of a becomes L of a = L S L^T, S of +1 and -1 on the diagonal, by halves.
/// @param workspace of a's size
/// @return whether there is one: without pivoting a pivot may be zero
template <typename Scalar>
bool factorise_with_signs(const DenseBlock<Scalar>& a, std::span<Scalar> signs,
                          const DenseBlock<Scalar>& workspace) {
  constexpr int kFew = 16;
  const int n = a.rows;
  if (n > kFew) {
    const int half = n / 2;
    const auto first = a.part(0, 0, half, half);
    const auto below = a.part(half, 0, n - half, half);
    if (!factorise_with_signs(first, signs.first(static_cast<std::size_t>(half)), workspace))
      return false;
    divide_by_transpose(first, below);
    const auto turned = workspace.part(0, 0, n - half, half);
    copy_to(DenseBlock<const Scalar>(below), turned);
    turn_columns<Scalar>(below, signs.first(static_cast<std::size_t>(half)));
    const auto second = a.part(half, half, n - half, n - half);
    multiply_by_transpose(Scalar(-1), DenseBlock<const Scalar>(below),
                          DenseBlock<const Scalar>(turned), Scalar(1), second);
    return factorise_with_signs(second, signs.subspan(static_cast<std::size_t>(half)), workspace);
  }
  for (int j = 0; j < n; ++j) {
    const Scalar pivot = *(a.column(j) + j);
    if (pivot == 0 || !std::isfinite(pivot)) return false;
    signs[static_cast<std::size_t>(j)] = pivot > 0 ? Scalar(1) : Scalar(-1);
    const Scalar root = std::sqrt(std::abs(pivot));
    const Scalar scale = 1 / (root * signs[static_cast<std::size_t>(j)]);
    *(a.column(j) + j) = root;
    for (int i = j + 1; i < n; ++i) *(a.column(j) + i) *= scale;
    for (int k = j + 1; k < n; ++k) {
      const Scalar factor = signs[static_cast<std::size_t>(j)] * *(a.column(j) + k);
      for (int i = k; i < n; ++i) *(a.column(k) + i) -= factor * *(a.column(j) + i);
    }
  }
  return true;
}

}  // namespace flexneck::fe_modal
