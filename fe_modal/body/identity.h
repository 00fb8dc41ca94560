// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include <Eigen/Core>

namespace flexneck::fe_modal {

/// "[2, 0]", for messages.
std::string entry_text(Eigen::Index row, Eigen::Index column);

/// Refuses a dataset of a modal body unless |difference| <= allowed.
/// @param identity what should hold and of which entry, e.g. "[2, 0] is minus [0, 2]"
/// @throws InputError "<dataset>: expected that <identity>, but it is off by ..., more than ..."
void require_identity(const std::string& dataset, const std::string& identity, double difference,
                      double allowed);

/// The same for each entry of a square matrix and the one across its diagonal.
void require_symmetric(const std::string& dataset, const Eigen::Ref<const Eigen::MatrixXd>& matrix,
                       double allowed);

/// For a matrix that is positive semidefinite but for rounding.
/// @param matrix symmetric, its diagonal not above 1
/// @param what the matrix is, for the message
void require_positive(const std::string& dataset, const std::string& what,
                      const Eigen::MatrixXd& matrix, double allowed);

/// Scales that make the diagonal of a matrix 1; 0 where all of a row is.
/// @throws InputError if an entry of the diagonal is negative, or zero and others of its row not
Eigen::VectorXd unit_scales(const std::string& dataset, const Eigen::MatrixXd& matrix);

}  // namespace flexneck::fe_modal
