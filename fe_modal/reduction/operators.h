// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include <Eigen/Core>

#include "fe_modal/modal_system.h"
#include "fe_modal/shift_inverse.h"

namespace flexneck::fe_modal {

/// A linear map of the free degrees of freedom, applied to each column.
using LinearMap = std::function<Eigen::MatrixXd(const Eigen::MatrixXd&)>;

/// All that the reduction of a body asks of its matrices, so that any solver can take the place of
/// the factor.
struct BodyOperators {
  LinearMap stiffness;  ///< K x, N/m
  LinearMap mass;       ///< M x, kg
  LinearMap solve;      ///< (K - shift M)^-1 f
  double shift = 0;     ///< zero for a held body, below zero for a free one, 1/s^2
};

/// @param system, inverse must outlive the operators
BodyOperators operators_of(const ModalSystem& system, const ShiftInverse& inverse);

}  // namespace flexneck::fe_modal
