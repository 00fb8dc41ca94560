// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/system/memory_needs.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "geometry/foundation/available_memory.h"

namespace flexneck::fe_modal {
namespace {

constexpr double kProgram = 0.09e9;         ///< libraries, before any input is read
constexpr double kAssembledPerDof = 3.8e3;  ///< mesh, graph, stiffness, mass, ten modes
/// Reference: a neck with so many degrees of freedom, in an order by nested dissection.
constexpr double kReferenceDofs = 191388;
constexpr double kReferenceEntries = 183.8e6;
constexpr double kGrowth = 1.42;
constexpr double kBytesPerEntry = 8;
/// Copies of a mode: two Krylov spaces, of which one is twice as wide, shapes and output.
constexpr double kBytesPerDof = 9 * 8;
constexpr int kIncluded = 10;  ///< number of modes in the figures above
/// Memory for each pair of modes: projected matrices and invariants.
constexpr double kBytesPerPair = 300;

std::string dofs_text(double dofs) {
  return std::to_string(std::llround(dofs)) + " degrees of freedom";
}

}  // namespace

MemoryNeeds memory_needs(double dofs, int mode_count) {
  const double more = std::max(0, mode_count - kIncluded);
  const double modes = more * (kBytesPerDof * dofs + kBytesPerPair * more);
  const double assembling = kProgram + kAssembledPerDof * dofs + modes;
  const double entries = kReferenceEntries * std::pow(dofs / kReferenceDofs, kGrowth);
  return {assembling, assembling + kBytesPerEntry * entries};
}

void check_memory(const mesher::Mesh& mesh, const ModalOptions& options) {
  constexpr double kCutInEight = 8;
  const double dofs = 3.0 * static_cast<double>(mesh.nodes.size());
  const auto require = [&](const std::string& doing, double count, const std::string& way_out) {
    require_memory(doing, memory_needs(count, options.mode_count).assembling, way_out);
  };
  require("assembling for " + std::to_string(options.mode_count) + " modes of " + dofs_text(dofs),
          dofs, "use a coarser mesh or fewer modes");
  if (options.check)
    require("the estimate of the discretisation error, with " + dofs_text(kCutInEight * dofs) + ",",
            kCutInEight * dofs, "use a coarser mesh, or omit modes.check");
}

}  // namespace flexneck::fe_modal
