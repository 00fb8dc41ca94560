// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/algebra/symmetric_sum.h"

namespace flexneck::fe_modal {
namespace {

/// Of each entry in the lower half, column by column.
Eigen::MatrixXd places_in_half(Eigen::Index size) {
  Eigen::MatrixXd places(size, size);
  double next = 0;
  for (Eigen::Index c = 0; c < size; ++c) {
    for (Eigen::Index r = c; r < size; ++r) places(r, c) = places(c, r) = next++;
  }
  return places;
}

}  // namespace

SymmetricSum::SymmetricSum(std::span<const Eigen::MatrixXd> terms)
    : sum_(places_in_half(terms.front().rows())) {
  places_.assign(sum_.entries().begin(), sum_.entries().end());
  constexpr std::size_t kTogether = kRowsTogether * kColumnsTogether;
  const Eigen::Index size = terms.front().rows();
  half_sum_.resize((static_cast<std::size_t>(size * (size + 1) / 2) + kTogether - 1) / kTogether);
  halves_.resize(half_sum_.size() * terms.size());
  for (std::size_t k = 0; k < terms.size(); ++k) {
    std::size_t place = 0;
    for (Eigen::Index c = 0; c < size; ++c) {
      for (Eigen::Index r = c; r < size; ++r) {
        Entries& entries = halves_[place / kTogether * terms.size() + k];
        const std::size_t row = place % kTogether / kColumnsTogether;
        entries[row].value[place % kColumnsTogether] = terms[k](r, c);
        ++place;
      }
    }
  }
}

const PackedMatrix& SymmetricSum::with(const Eigen::VectorXd& factors, VectorRegisters registers) {
  const auto count = static_cast<std::size_t>(factors.size());
  run_with(
      registers, [&]<std::size_t bytes>() __attribute__((always_inline)) {
        const Entries* terms = halves_.data();
        for (Entries& result : half_sum_) {
          RegisterRow<double, bytes> sums[kRowsTogether] = {};
          for (std::size_t k = 0; k < count; ++k, ++terms) {
            for (std::size_t r = 0; r < kRowsTogether; ++r) {
              RegisterRow<double, bytes> term;
              term.load((*terms)[r]);
              sums[r].add(factors.data()[k], term);
            }
          }
          for (std::size_t r = 0; r < kRowsTogether; ++r) sums[r].store(result[r]);
        }
      });
  const double* const half = half_sum_.front().front().value;
  const std::span<double> entries = sum_.entries();
  for (std::size_t e = 0; e < entries.size(); ++e) entries[e] = half[places_[e]];
  return sum_;
}

}  // namespace flexneck::fe_modal
