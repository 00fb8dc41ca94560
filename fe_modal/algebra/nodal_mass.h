// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include <Eigen/SparseCore>

namespace flexneck::fe_modal {

/// Consistent mass between nodes, (n, n), kg: the same in each direction.
using NodalMass = Eigen::SparseMatrix<double, Eigen::RowMajor, std::int32_t>;

}  // namespace flexneck::fe_modal
