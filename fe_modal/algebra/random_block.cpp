// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/algebra/random_block.h"

#include <cmath>
#include <random>

namespace flexneck::fe_modal {
namespace {

constexpr const char* kAsking = "asking for the size of a matrix";

}  // namespace

Eigen::Index size_of(Mat matrix) {
  PetscInt size = 0;
  require(MatGetSize(matrix, &size, nullptr), kAsking);
  return size;
}

Eigen::MatrixXd random_block(Mat matrix, Eigen::Index columns, std::uint64_t seed) {
  PetscInt first = 0;
  PetscInt end = 0;
  require(MatGetOwnershipRange(matrix, &first, &end), kAsking);
  const auto size = static_cast<unsigned long long>(size_of(matrix));
  Eigen::MatrixXd block(end - first, columns);
  std::mt19937_64 generator(seed);
  generator.discard(static_cast<unsigned long long>(first));
  for (Eigen::Index k = 0; k < columns; ++k) {
    // Not std::uniform_real_distribution, whose numbers differ from library to library.
    for (double& x : block.col(k)) {
      x = std::ldexp(static_cast<double>(generator() >> 11U), -53) - 0.5;
    }
    generator.discard(size - static_cast<unsigned long long>(end - first));
  }
  return block;
}

}  // namespace flexneck::fe_modal
