// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "fe_modal/algebra/operator_matrix.h"
#include "fe_modal/solve/linear_solver.h"
#include "fe_modal/system/modal_system.h"

namespace flexneck::fe_modal {

/// Operators of a body's matrices for its reduction.
struct BodyOperators {
  BlockOperator stiffness;  ///< K x, N/m
  BlockOperator mass;       ///< M x, kg
  BlockOperator solve;      ///< (K - shift M)^-1 f
  double shift = 0;         ///< zero for a fixed body, below zero for a free one, 1/s^2
  Ranks ranks = {};         ///< ranks whose rows the operators take and give
};

/// @param system, inverse must outlive the operators
BodyOperators operators_of(const ModalSystem& system, const LinearSolver& inverse);

}  // namespace flexneck::fe_modal
