// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "fe_modal/algebra/cholmod_order.h"
#include "fe_modal/algebra/ghost_exchange.h"
#include "fe_modal/algebra/operator_matrix.h"
#include "fe_modal/solve/iterative/subdomains.h"
#include "fe_modal/system/assembly.h"
#include "fe_modal/system/field_map.h"
#include "fe_modal/system/modal_options.h"
#include "fe_modal/system/modal_system.h"
#include "fe_modal/system/rank_part.h"

namespace flexneck::fe_modal {

struct DistributedMatrix;

/// K and M of a mesh, assembled by the ranks of the options, each from its elements. K - shift M is
/// factorised, in one process or by all ranks together, or solved with by iteration.
class AssembledSystem : public ModalSystem {
 public:
  /// @param mesh, dof_map must outlive this; the same on all ranks
  /// @throws what assemble() throws on any rank.
  AssembledSystem(const mesher::Mesh& mesh, const DofMap& dof_map, const ModalOptions& options);

  const FieldMap& fields() const { return fields_; }
  const Ranks& ranks() const { return fields_.ranks(); }
  /// Of elements, springs and masses, as for_each_element() counts them; empty alone.
  const std::vector<std::int32_t>& rank_of_element() const { return sharing_.rank_of_element; }

  Mat stiffness() const override { return stiffness_->get(); }
  Mat mass() const override { return mass_->get(); }
  std::unique_ptr<ShiftInverse> shift_inverse(double shift) const override;
  std::optional<Eigen::Index> eigenvalues_below(double sigma,
                                                const Eigen::MatrixXd& known) const override;

  /// Frees K, its graph and nodal_mass(), an eighth of the memory of a certificate. Afterwards
  /// mass() is all that may be asked for, and inverses that multiply by K, as iterations do, are of
  /// no use.
  void keep_mass_alone();

  /// Between the nodes of this rank's elements; alone between all, kg.
  const NodalMass& nodal_mass() const { return matrices_->nodal_mass; }
  /// int rho f g dV of all pairs of fields on all nodes, (n, k) -> (k, k).
  Eigen::MatrixXd mass_integrals(const Eigen::MatrixXd& fields) const;
  /// M a of accelerations of all nodes on the free degrees of freedom, a column each.
  Eigen::MatrixXd inertia_forces(std::span<const Eigen::Matrix3Xd> accelerations) const;

 private:
  /// How the elements are shared out.
  struct Sharing {
    std::optional<Subdomains> subdomains;       ///< of the iterative solver
    std::vector<std::int32_t> rank_of_element;  ///< empty in a process alone
  };
  static Sharing share_out(const mesher::Mesh& mesh, const DofMap& dof_map,
                           const ModalOptions& options);
  AssembledSystem(const mesher::Mesh& mesh, const DofMap& dof_map, const ModalOptions& options,
                  Sharing sharing);

  enum class Precision { of_single, of_double };
  std::unique_ptr<ShiftInverse> factor(double shift, Precision precision) const;

  /// Of elimination of all blocks, on the first rank.
  const std::vector<std::int32_t>& order() const;

  /// The same for a factor in one process.
  struct Elimination {
    CholmodOrder kind;
    std::span<const std::int32_t> order;
  };
  Elimination elimination() const;

  /// A matrix of this rank's elements with its place in the whole.
  DistributedMatrix distributed(const SymmetricMatrix& summand) const;

  const mesher::Mesh& mesh_;
  FormulationChoice formulation_;
  Eigen::Matrix3Xd prestress_m_;
  Solver solver_;
  Sharing sharing_;
  FieldMap fields_;
  RankPart part_;
  GhostExchange exchange_;
  std::unique_ptr<SystemMatrices> matrices_;  ///< of this rank's elements
  mutable std::vector<std::int32_t> order_;   ///< found when it is asked for, by the first rank
  mutable bool has_order_;                    ///< the same on all ranks
  std::optional<OperatorMatrix> stiffness_;   ///< both point to this
  std::optional<OperatorMatrix> mass_;
};

}  // namespace flexneck::fe_modal
