// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>

#include <Eigen/Core>

#include "fe_modal/algebra/ghost_exchange.h"
#include "fe_modal/algebra/shift_inverse.h"
#include "fe_modal/solve/assembled_system.h"
#include "fe_modal/solve/refined/mesh_transfer.h"
#include "fe_modal/solve/refined/star_patches.h"
#include "fe_modal/system/element_operator.h"
#include "mesher/mesh/refinement.h"

namespace flexneck::fe_modal {

/// A body whose mesh is refined: products with its stiffness and mass, and what takes the place of
/// a factor, which would be some thirty times that of the mesh before: stars, and corrections by
/// that mesh's inverse. Elements are of the ranks that had their parents. Vectors are this rank's
/// rows; every member is collective.
class RefinedSystem {
 public:
  /// @param coarse, inverse of the mesh before; all must outlive this
  /// @param dof_map of the refined mesh
  /// @param options of the refined mesh: formulation and displacements of the prestress
  /// @throws what assemble() throws, or ComputationError if the stiffness is not definite.
  RefinedSystem(const AssembledSystem& coarse, const ShiftInverse& inverse,
                const mesher::RefinedMesh& refined, const DofMap& dof_map,
                const ModalOptions& options);
  RefinedSystem(const RefinedSystem&) = delete;
  RefinedSystem& operator=(const RefinedSystem&) = delete;

  const FieldMap& fields() const { return fields_; }
  const Ranks& ranks() const { return fields_.ranks(); }

  ElementOperator::Products products(const Eigen::MatrixXd& columns) const;
  Eigen::MatrixXd forces(const Eigen::MatrixXd& columns) const;
  Eigen::MatrixXd prolonged(const Eigen::MatrixXd& coarse) const {
    Eigen::MatrixXd fine(fields_.own_dof_count(), coarse.cols());
    transfer_.to_fine(coarse, fine);
    return fine;
  }
  /// By the mesh before and the stars, of which it takes several times the solution, added up:
  /// symmetric.
  /// @param directions of the residuals' shape; their memory is written to
  void precondition(const Eigen::MatrixXd& residuals, Eigen::MatrixXd& directions) const;
  /// Whether add_cells() finds anything, on any rank.
  bool has_cells() const { return has_cells_; }
  /// Adds solutions within the elements of the mesh before, StarPatches::add_cells().
  void add_cells(double weight, const Eigen::MatrixXd& residuals, Eigen::MatrixXd& sums) const;

 private:
  /// Elements around the corners that this rank has, whose stars are whole there.
  struct Around {
    RankPart part;
    GhostExchange exchange;
  };

  using AddSolutions = void (StarPatches::*)(double, const Eigen::MatrixXd&,
                                             Eigen::MatrixXd&) const;
  void add_solutions(AddSolutions add, double weight, const Eigen::MatrixXd& residuals,
                     Eigen::MatrixXd& sums) const;

  const ShiftInverse& inverse_;
  std::vector<std::int32_t> rank_of_element_;
  FieldMap fields_;
  RankPart part_;
  GhostExchange exchange_;
  MeshTransfer transfer_;
  std::optional<ElementOperator> operator_;
  std::optional<Around> around_;  ///< nothing in a process alone
  std::unique_ptr<const StarPatches> stars_;
  bool has_cells_;
  double star_weight_;  ///< of their solutions beside that of the mesh before
};

}  // namespace flexneck::fe_modal
