// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/solve/distributed/partial_system.h"

#include <optional>

#include "fe_modal/solve/distributed/messages.h"

namespace flexneck::fe_modal {
namespace {

constexpr const char* kMultiplying = "multiplying with a rank's stiffness";

}  // namespace

PartialSystem::PartialSystem(const Share& share)
    : nodes_(share.free_global),
      matrices_(
          assemble(share.mesh, DofMap(share.free_index, share.free_count()), share.formulation)) {}

void PartialSystem::multiply_stiffness(std::span<const double> x, std::span<double> y) const {
  const VecHandle in = vector_on(x);
  const VecHandle out = vector_on(y);
  require(MatMult(matrices_.stiffness.get(), in.get(), out.get()), kMultiplying);
}

std::unique_ptr<MumpsFactor> PartialSystem::factorise(MPI_Comm ranks, MumpsFactor::Kind kind,
                                                      double shift,
                                                      std::span<const std::int32_t> node_order) {
  if (shift == 0) {
    return std::make_unique<MumpsFactor>(ranks, kind, matrices_.stiffness, nodes_, node_order);
  }
  std::optional<SymmetricMatrix> shifted;
  together(ranks, [&] { shifted = shifted_stiffness(matrices_, shift); });
  return std::make_unique<MumpsFactor>(ranks, kind, *shifted, nodes_, node_order);
}

}  // namespace flexneck::fe_modal
