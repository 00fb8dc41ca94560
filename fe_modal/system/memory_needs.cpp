// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/system/memory_needs.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "fe_modal/algebra/cholesky_factor.h"
#include "geometry/foundation/available_memory.h"

namespace flexneck::fe_modal {
namespace {

constexpr double kProgram = 0.09e9;         ///< libraries, before anything is read
constexpr double kAssembledPerDof = 3.8e3;  ///< mesh, graph, stiffness, mass, ten modes
constexpr double kIterativePerDof = 6.2e3;  ///< those and the subdomains' factors
/// Of the finer mesh of a certificate, beside what its own mesh takes: thirty columns of vectors,
/// forces and momenta, and the factors of stars (calibrated: 680 to 850 measured).
constexpr double kRefinedPerDof = 0.95e3;
/// Of a neck with so many degrees of freedom, in an order by nested dissection.
constexpr double kReferenceDofs = 191388;
constexpr double kReferenceEntries = 183.8e6;
constexpr double kGrowth = 1.42;
/// Copies of a mode: two Krylov spaces, of which one is twice as wide, shapes and what is written.
constexpr double kBytesPerDof = 9 * 8;
constexpr int kIncluded = 10;  ///< modes that the figures above have
/// Of pairs of modes: projected matrices and invariants.
constexpr double kBytesPerPair = 300;

std::string dofs_text(double dofs) {
  return std::to_string(std::llround(dofs)) + " degrees of freedom";
}

}  // namespace

MemoryNeeds memory_needs(double dofs, Solver solver, int mode_count) {
  const double more = std::max(0, mode_count - kIncluded);
  const double modes = more * (kBytesPerDof * dofs + kBytesPerPair * more);
  const double assembling = kProgram + kAssembledPerDof * dofs + modes;
  if (solver == Solver::iterative) {
    return {assembling, kProgram + kIterativePerDof * dofs + modes};
  }
  const double entries = kReferenceEntries * std::pow(dofs / kReferenceDofs, kGrowth);
  return {assembling, assembling + kBytesPerSingleEntry * entries};
}

void check_memory(const mesher::Mesh& mesh, const ModalOptions& options) {
  const double dofs = 3.0 * static_cast<double>(mesh.nodes.size());
  const bool is_iterative = options.solver == Solver::iterative;
  const auto known = [&](double count) {
    const MemoryNeeds needs = memory_needs(count, options.solver, options.mode_count);
    return is_iterative ? needs.peak : needs.assembling;
  };
  const std::string what = std::to_string(options.mode_count) + " modes of " + dofs_text(dofs);
  require_memory(is_iterative ? "solving for " + what + " by iteration" : "assembling for " + what,
                 known(dofs), "take a coarser mesh or fewer modes");
  if (!options.certify) return;
  constexpr double kCutInEight = 8;
  require_memory("the mesh's error, estimated with " + dofs_text(kCutInEight * dofs) + ",",
                 known(dofs) + kRefinedPerDof * kCutInEight * dofs,
                 "take a coarser mesh, or leave out modes.certify");
}

}  // namespace flexneck::fe_modal
