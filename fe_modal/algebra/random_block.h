// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "fe_modal/algebra/petsc_handles.h"

namespace flexneck::fe_modal {

/// Rows and columns of a square matrix, on all ranks.
Eigen::Index size_of(Mat matrix);

/// Numbers between -1/2 and 1/2 for this rank's rows of a matrix: each eigenspace has its share in
/// each column.
Eigen::MatrixXd random_block(Mat matrix, Eigen::Index columns, std::uint64_t seed);

}  // namespace flexneck::fe_modal
