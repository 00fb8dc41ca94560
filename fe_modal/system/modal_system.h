// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "fe_modal/algebra/petsc_handles.h"
#include "fe_modal/system/solver.h"

namespace flexneck::fe_modal {

/// K and M of a body, assembled or read from files. Vectors are this rank's rows.
class ModalSystem {
 public:
  ModalSystem() = default;
  virtual ~ModalSystem() = default;
  ModalSystem(const ModalSystem&) = delete;
  ModalSystem& operator=(const ModalSystem&) = delete;

  virtual Mat stiffness() const = 0;  ///< N/m, symmetric, upper half
  virtual Mat mass() const = 0;       ///< kg, symmetric
  virtual const Ranks& ranks() const = 0;
  virtual Solver solver() const = 0;
};

}  // namespace flexneck::fe_modal
