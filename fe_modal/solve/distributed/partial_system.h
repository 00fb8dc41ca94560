// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <span>

#include "fe_modal/solve/distributed/mumps_factor.h"
#include "fe_modal/solve/distributed/share.h"
#include "fe_modal/system/assembly.h"

namespace flexneck::fe_modal {

/// What a rank has of K and M: the matrices of its share, which it assembles.
class PartialSystem {
 public:
  /// @throws what assemble() throws.
  explicit PartialSystem(const Share& share);

  /// Numbers of its free nodes among those of the body.
  const std::vector<std::int32_t>& nodes() const { return nodes_; }
  /// Between the nodes of the share, fixed ones too.
  const NodalMass& nodal_mass() const { return matrices_.nodal_mass; }
  void drop_nodal_mass() { NodalMass().swap(matrices_.nodal_mass); }

  /// K x of the share, three numbers a node of nodes().
  void multiply_stiffness(std::span<const double> x, std::span<double> y) const;
  /// The factor of the sum of all ranks' K - shift M. Collective.
  std::unique_ptr<MumpsFactor> factorise(MPI_Comm ranks, MumpsFactor::Kind kind, double shift,
                                         std::span<const std::int32_t> node_order);

 private:
  std::vector<std::int32_t> nodes_;
  SystemMatrices matrices_;
};

}  // namespace flexneck::fe_modal
