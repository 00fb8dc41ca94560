// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include <Eigen/Core>

namespace flexneck::fe_modal {

/// Text of an entry for messages, "[2, 0]".
std::string entry_text(Eigen::Index row, Eigen::Index column);

/// Refuses a dataset of a modal body unless |difference| <= allowed.
/// @param identity the relation and the entry that it is for, e.g. "[2, 0] is minus [0, 2]"
/// @throws InputError "<dataset>: expected that <identity>, but it is off by ..., more than ..."
void require_identity(const std::string& dataset, const std::string& identity, double difference,
                      double allowed);

/// Refuses a square matrix that is not symmetric within `allowed`.
void require_symmetric(const std::string& dataset, const Eigen::Ref<const Eigen::MatrixXd>& matrix,
                       double allowed);

/// Refuses a matrix that is not positive semidefinite but for rounding.
/// @param matrix symmetric, its diagonal not above 1
/// @param what name of the matrix for the message
void require_positive(const std::string& dataset, const std::string& what,
                      const Eigen::MatrixXd& matrix, double allowed);

/// Scales that make the diagonal of a matrix 1; 0 for rows of zeros.
/// @throws InputError if an entry of the diagonal is negative, or zero in a row with other entries
Eigen::VectorXd unit_scales(const std::string& dataset, const Eigen::MatrixXd& matrix);

}  // namespace flexneck::fe_modal
