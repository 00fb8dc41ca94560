// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "fe_modal/dofs/dof_map.h"
#include "fe_modal/solve/local_system.h"

namespace flexneck::fe_modal {

/// Assembled in this process and solved by iteration, for bodies whose factor does not fit: no more
/// than subdomains of some ten thousand nodes are factorised.
class IterativeSystem : public LocalSystem {
 public:
  /// @param mesh, dof_map must outlive this
  IterativeSystem(SystemMatrices matrices, const mesher::Mesh& mesh, const DofMap& dof_map)
      : LocalSystem(std::move(matrices)), mesh_(mesh), dof_map_(dof_map) {}

  std::unique_ptr<ShiftInverse> shift_inverse(double shift) const override;
  /// @throws InputError: inertia takes a factorisation.
  Eigen::Index eigenvalues_below(double sigma) const override;

 private:
  class Inverse;

  const mesher::Mesh& mesh_;
  const DofMap& dof_map_;
};

}  // namespace flexneck::fe_modal
