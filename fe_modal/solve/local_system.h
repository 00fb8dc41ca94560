// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "fe_modal/system/assembly.h"
#include "fe_modal/system/modal_system.h"

namespace flexneck::fe_modal {

/// Assembled in this process and factorised by CHOLMOD in an order by nested dissection.
class LocalSystem : public ModalSystem {
 public:
  /// @param node_order of the free nodes; empty: by nested dissection
  explicit LocalSystem(SystemMatrices matrices, std::vector<std::int32_t> node_order = {});

  Mat stiffness() const override { return stiffness_.get(); }
  Mat mass() const override { return matrices_.mass_operator(); }
  const NodalMass& nodal_mass() const override { return matrices_.nodal_mass; }
  std::unique_ptr<ShiftInverse> shift_inverse(double shift) const override;
  Eigen::Index eigenvalues_below(double sigma) const override;

 protected:
  const SystemMatrices& matrices() const { return matrices_; }

 private:
  SystemMatrices matrices_;
  std::vector<std::int32_t> node_order_;
  OperatorMatrix stiffness_;  ///< points to the matrices
};

}  // namespace flexneck::fe_modal
