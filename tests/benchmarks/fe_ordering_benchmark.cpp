// SPDX-License-Identifier: GPL-3.0-or-later
// Fill and time of the Cholesky factor with our order of elimination and with CHOLMOD's own.
// README.md says what is compared.
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <vector>

#include "fe_modal/algebra/petsc_session.h"
#include "fe_modal/analysis/modal_analysis.h"
#include "fe_modal/solve/linear_solver.h"
#include "fe_modal/system/assembly.h"
#include "fe_modal/system/elimination_order.h"
#include "tests/support/neck_mesh.h"

namespace {

using namespace flexneck;
using namespace flexneck::fe_modal;

constexpr int kDefaultRefinement = 1;

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void compare(int refinement) {
  geometry::NeckDivisions divisions;
  divisions.refine = refinement;
  const mesher::Mesh mesh = testing::neck_mesh("C", divisions);
  DofMap dof_map(mesh, mesh.node_set("bolts").nodes);
  const SystemMatrices system = assemble(mesh, dof_map);
  std::printf("neck C, hex27, %ld degrees of freedom\n", static_cast<long>(dof_map.dof_count()));
  std::printf("%-36s %9s %12s %16s\n", "order of elimination", "order s", "factorise s", "entries");
  {
    const auto start = std::chrono::steady_clock::now();
    const LinearSolver factor(system.stiffness.get(), 0);
    std::printf("%-36s %9s %12.3f %16.0f\n", "numbering of the mesh", "none", seconds_since(start),
                factor.nonzeros());
  }
  auto start = std::chrono::steady_clock::now();
  const std::vector<std::int32_t> order = elimination_order_of(mesh, dof_map, {});
  const double ordering = seconds_since(start);
  dof_map.renumber(order);
  const SystemMatrices in_order = assemble(mesh, dof_map);
  start = std::chrono::steady_clock::now();
  const LinearSolver factor(in_order.stiffness.get(), 0);
  std::printf("%-36s %9.3f %12.3f %16.0f\n", "nested dissection of the nodes", ordering,
              seconds_since(start), factor.nonzeros());
}

}  // namespace

int main(int argc, char** argv) {
  const int refinement = argc > 1 ? std::atoi(argv[1]) : kDefaultRefinement;
  if (refinement < 0) {
    std::fprintf(stderr, "usage: %s [REFINEMENT]\n", argv[0]);
    return 2;
  }
  try {
    const PetscSession session;
    compare(refinement);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
