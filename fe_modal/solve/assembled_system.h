// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "fe_modal/system/assembly.h"
#include "fe_modal/system/modal_system.h"
#include "fe_modal/system/model.h"

namespace flexneck::fe_modal {

/// K and M of a model, assembled by its ranks, each from its elements.
class AssembledSystem : public ModalSystem {
 public:
  /// @param model must outlive this
  /// @throws as assemble() does on any rank.
  explicit AssembledSystem(const Model& model) : model_(model), matrices_(assemble(model)) {}

  const Model& model() const { return model_; }
  const FieldMap& fields() const { return model_.fields(); }
  const Ranks& ranks() const override { return model_.ranks(); }

  Mat stiffness() const override { return matrices_.stiffness.get(); }
  Mat mass() const override { return matrices_.mass.get(); }
  Solver solver() const override { return model_.options().solver; }

  /// Rigid motions of the body under its supports, M-orthonormal, (own dofs, k).
  Eigen::MatrixXd rigid_modes() const;
  /// Mass between the nodes of this rank's elements, in a serial run between all nodes, kg.
  const NodalMass& nodal_mass() const { return matrices_.nodal_mass; }
  /// Integrals int rho f g dV of all pairs of fields on all nodes, (n, k) -> (k, k).
  Eigen::MatrixXd mass_integrals(const Eigen::MatrixXd& fields) const;
  /// Forces M a on the free degrees of freedom for accelerations a of all nodes, a column for each
  /// field.
  Eigen::MatrixXd inertia_forces(std::span<const Eigen::Matrix3Xd> accelerations) const;

 private:
  const Model& model_;
  SystemMatrices matrices_;
};

}  // namespace flexneck::fe_modal
