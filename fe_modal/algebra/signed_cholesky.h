// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "fe_modal/algebra/blas.h"
#include "fe_modal/algebra/pivots.h"
#include "geometry/foundation/error.h"

namespace flexneck::fe_modal {

/// Room for a block in a workspace that grows where it must.
template <typename Scalar>
DenseBlock<Scalar> room_for(int rows, int columns, std::vector<Scalar>& workspace) {
  const std::size_t size = static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns);
  if (workspace.size() < size) workspace.resize(size);
  return {workspace.data(), rows, columns, rows};
}

template <typename Scalar>
DenseBlock<Scalar> copy(const DenseBlock<const Scalar>& block, std::vector<Scalar>& workspace) {
  const DenseBlock<Scalar> result = room_for(block.rows, block.columns, workspace);
  copy_to(block, result);
  return result;
}

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

/// The lower triangle of a becomes L of a = L S L^T, without S where all pivots are positive.
/// @param signs takes S; only read and written if pivots may have any sign, and before all +1
/// @return whether a pivot is negative
/// @throws ComputationError if there is no such factor.
template <typename Scalar>
bool factorise_diagonal(const DenseBlock<Scalar>& a, Pivots pivots, std::span<Scalar> signs,
                        std::vector<Scalar>& workspace) {
  DenseBlock<Scalar> before{};
  if (pivots == Pivots::of_any_sign) before = copy(DenseBlock<const Scalar>(a), workspace);
  bool is_done = factorise_in_place(a);
  // OpenBLAS lets pivots pass that are not numbers.
  for (int j = 0; j < a.columns; ++j) is_done = is_done && std::isfinite(a.column(j)[j]);
  if (is_done) return false;
  if (pivots == Pivots::of_any_sign) {
    copy_to(DenseBlock<const Scalar>(before), a);
    is_done = factorise_with_signs(a, signs, before);
  }
  if (!is_done) throw ComputationError(kNotDefinite);
  return true;
}

/// result = factor a S b^T + keep result
/// @param signs S, without a factor where it is empty
template <typename Scalar>
void multiply_with_signs(Scalar factor, const DenseBlock<const Scalar>& a,
                         std::span<const Scalar> signs, const DenseBlock<const Scalar>& b,
                         Scalar keep, const DenseBlock<Scalar>& result,
                         std::vector<Scalar>& workspace) {
  if (signs.empty()) return multiply_by_transpose(factor, a, b, keep, result);
  const DenseBlock<Scalar> turned = copy(b, workspace);
  turn_columns<Scalar>(turned, signs);
  multiply_by_transpose(factor, a, DenseBlock<const Scalar>(turned), keep, result);
}

}  // namespace flexneck::fe_modal
