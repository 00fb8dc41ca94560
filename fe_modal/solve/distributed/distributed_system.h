// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "fe_modal/solve/distributed/partial_system.h"
#include "fe_modal/solve/distributed/ranks.h"
#include "fe_modal/solve/distributed/worker.h"
#include "fe_modal/system/modal_system.h"

namespace flexneck::fe_modal {

/// K and its factors shared among ranks, as rank 0 sees them. Vectors and M, which hold a hundredth
/// and a twentieth of the numbers, are on rank 0 alone: whatever works with one process works here.
class DistributedSystem : public ModalSystem {
 public:
  /// @param partition one process for each rank
  /// @param node_order of all free nodes, or empty: by nested dissection
  /// @throws what assemble() throws on any rank.
  DistributedSystem(const Ranks& team, const mesher::Mesh& mesh, const DofMap& dof_map,
                    const FormulationChoice& formulation, const mesher::ElementPartition& partition,
                    std::vector<std::int32_t> node_order);

  Mat stiffness() const override { return stiffness_.get(); }
  Mat mass() const override { return mass_->get(); }
  const NodalMass& nodal_mass() const override { return nodal_mass_; }
  std::unique_ptr<ShiftInverse> shift_inverse(double shift) const override;
  Eigen::Index eigenvalues_below(double sigma) const override;

 private:
  class Inverse;

  void order_all(const Order& order) const;
  void assemble_shares(std::vector<Share>& shares);
  void gather_mass(const mesher::Mesh& mesh, const std::vector<Share>& shares);
  void add_mass(const std::vector<std::int32_t>& nodes, const std::int32_t* offsets,
                const std::int32_t* columns, const double* values);
  /// y += K x
  void add_forces(const double* x, double* y) const;

  const Ranks& team_;
  MPI_Comm ranks_ = MPI_COMM_WORLD;
  std::vector<std::int32_t> node_order_;
  std::vector<std::vector<std::int32_t>> nodes_of_;  ///< of each rank, as PartialSystem::nodes
  std::unique_ptr<PartialSystem> own_;
  NodalMass nodal_mass_;
  std::unique_ptr<MassMatrix> mass_;
  OperatorMatrix stiffness_;  ///< points to this
  mutable int last_factor_ = 0;
};

}  // namespace flexneck::fe_modal
