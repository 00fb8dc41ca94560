// SPDX-License-Identifier: GPL-3.0-or-later
// First frequencies of a bonded rubber pad with every element. README.md describes the comparison.
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <numbers>
#include <string>

#include "fe_modal/algebra/petsc_session.h"
#include "fe_modal/analysis/modal_analysis.h"
#include "fe_modal/solve/eigensolver.h"
#include "fe_modal/solve/linear_solver.h"
#include "fe_modal/system/assembly.h"
#include "fe_modal/system/elimination_order.h"
#include "geometry/foundation/error.h"
#include "tests/support/block_mesh.h"
#include "tests/support/element_choices.h"
#include "tests/support/element_meshes.h"

namespace {

using namespace flexneck;
using namespace flexneck::fe_modal;
using mesher::ElementKind;

/// Pad of 80 x 80 mm, fixed below: 20 mm of rubber and on it 10 mm of steel.
mesher::Mesh pad(int refinement, double poissons_ratio) {
  testing::BlockMesh block =
      testing::box({4 * refinement, 4 * refinement, 1}, {0.08, 0.08, 0.03}, {});
  block.slices = {{"pad", 2 * refinement, {"rubber", 8.3e6, poissons_ratio, 950}},
                  {"plate", refinement, {"steel", 2.1e11, 0.3, 7850}}};
  return block.make();
}

void print_row(ElementKind kind, Formulation formulation, double poissons_ratio, int finest) {
  std::printf("%-8s %-15s", std::string(mesher::name_of(kind)).c_str(),
              std::string(name_of(formulation)).c_str());
  for (int refinement = 1; refinement <= finest; ++refinement) {
    const mesher::Mesh mesh = testing::with_kind(pad(refinement, poissons_ratio), kind);
    DofMap dof_map(mesh, mesh.node_set("bottom").nodes);
    dof_map.renumber(elimination_order_of(mesh, dof_map, {}));
    const SystemMatrices system = assemble(mesh, dof_map, {formulation});
    const LinearSolver factor(system.stiffness.get(), 0);
    const EigenPairs pairs = lowest_eigenpairs(system.mass.get(), factor, 4);
    const Eigen::VectorXd hertz = pairs.values.cwiseSqrt() / (2 * std::numbers::pi);
    // The first two are one pair: rocking in x and in y.
    std::printf(" |%7ld %8.2f %8.2f %8.2f", static_cast<long>(dof_map.dof_count()), hertz[0],
                hertz[2], hertz[3]);
  }
  std::printf("\n");
}

}  // namespace

int main(int argc, char** argv) {
  const int finest = argc > 1 ? std::atoi(argv[1]) : 3;
  if (finest < 1) {
    std::fprintf(stderr, "usage: %s [FINEST REFINEMENT]\n", argv[0]);
    return 2;
  }
  try {
    const PetscSession session;
    for (const double poissons_ratio : {0.3, 0.49, 0.4999}) {
      std::printf("Poisson's ratio %g: DOF, rocking, twist, stretch in Hz by refinement\n",
                  poissons_ratio);
      for (const ElementKind kind : kVolumes) {
        for (const Formulation formulation : kFormulations) {
          if (offered(kind, formulation)) print_row(kind, formulation, poissons_ratio, finest);
        }
      }
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
