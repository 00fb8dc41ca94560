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
  /// @throws what assemble() throws on any rank.
  explicit AssembledSystem(const Model& model) : model_(model), matrices_(assemble(model)) {}

  const Model& model() const { return model_; }
  const FieldMap& fields() const { return model_.fields(); }
  const Ranks& ranks() const override { return model_.ranks(); }

  Mat stiffness() const override { return matrices_.stiffness.get(); }
  Mat mass() const override { return matrices_.mass.get(); }
  Solver solver() const override { return model_.options().solver; }

  /// The rigid motions that the body keeps, M-orthonormal, (own dofs, k).
  Eigen::MatrixXd rigid_modes() const;
  /// Between the nodes of this rank's elements; alone between all, kg.
  const NodalMass& nodal_mass() const { return matrices_.nodal_mass; }
  /// int rho f g dV of all pairs of fields on all nodes, (n, k) -> (k, k).
  Eigen::MatrixXd mass_integrals(const Eigen::MatrixXd& fields) const;
  /// M a of accelerations of all nodes on the free degrees of freedom, a column each.
  Eigen::MatrixXd inertia_forces(std::span<const Eigen::Matrix3Xd> accelerations) const;

 private:
  const Model& model_;
  SystemMatrices matrices_;
};

}  // namespace flexneck::fe_modal
