// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>

#include <Eigen/Core>

#include "fe_modal/algebra/petsc_handles.h"
#include "fe_modal/algebra/shift_inverse.h"

namespace flexneck::fe_modal {

/// K and M of a body and what is done with them, wherever their entries are: in this process,
/// distributed among ranks, or read from files. Vectors are this rank's rows; every member is
/// collective.
class ModalSystem {
 public:
  ModalSystem() = default;
  virtual ~ModalSystem() = default;
  ModalSystem(const ModalSystem&) = delete;
  ModalSystem& operator=(const ModalSystem&) = delete;

  virtual Mat stiffness() const = 0;  ///< N/m, symmetric; perhaps only good for products
  virtual Mat mass() const = 0;       ///< kg, likewise
  /// (K - shift M)^-1; the system must outlive it.
  /// @throws ComputationError if K - shift M is not positive definite, or for want of memory.
  virtual std::unique_ptr<ShiftInverse> shift_inverse(double shift) const = 0;
  /// Number of eigenvalues below sigma, by inertia; nothing where the solver does without a factor
  /// and memory would not hold one.
  /// @param known (own dofs, k) modes near sigma, of which k may be 0: with them a factor of less
  /// precision counts, if one does. The number is that of K and M whatever they are.
  /// @throws ComputationError if sigma is an eigenvalue to rounding, or the factorisation fails.
  virtual std::optional<Eigen::Index> eigenvalues_below(double sigma,
                                                        const Eigen::MatrixXd& known) const = 0;
};

}  // namespace flexneck::fe_modal
