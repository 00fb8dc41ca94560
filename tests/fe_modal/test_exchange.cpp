// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "fe_modal/analysis/modal_analysis.h"
#include "fe_modal/exchange/exported_matrices.h"
#include "geometry/foundation/error.h"
#include "geometry/foundation/temporary_folder.h"
#include "tests/support/block_mesh.h"

namespace flexneck::fe_modal {
namespace {

mesher::Mesh column() {
  return testing::box({1, 2, 3}, {0.05, 0.06, 0.3}, {"steel", 2.1e11, 0.3, 7850}).make();
}

ImportedBody matrices(const mesher::Mesh& mesh) {
  return export_matrices(mesh, DofMap(mesh, mesh.node_set("bottom").nodes),
                         {Formulation::mixed_pressure});
}

}  // namespace

TEST_CASE("matrices that went out and came back have the frequencies of the mesh") {
  mesher::Mesh mesh = column();
  const std::int32_t top = mesh.node_set("top").nodes.front();
  mesh.connections.springs = {{"s", {{top, {0.6, 0, 0.8}}}, 3000}};
  mesh.connections.masses = {{"m", top, 0.7, {}, {}}};
  ModalOptions options;
  options.mode_count = 5;
  options.fixed_set = "bottom";
  const ModalBody truth = analyse_modes(mesh, options, {});
  const ImportedBody out = matrices(mesh);
  for (const std::string ending : {".mtx", ".petsc"}) {
    INFO(ending);
    const TemporaryFolder folder;
    write_matrix(folder / ("K" + ending), out.stiffness);
    write_matrix(folder / ("M" + ending), out.mass);
    write_positions(folder / ("nodes" + ending), out.nodes_m);
    const ImportedBody in{read_matrix(folder / ("K" + ending)),
                          read_matrix(folder / ("M" + ending)),
                          read_positions(folder / ("nodes" + ending))};
    options.check = true;
    const ModalBody body = analyse_matrices(in, options, {});
    CHECK(body.frequencies_Hz.isApprox(truth.frequencies_Hz, 1e-9));
    CHECK(body.completeness.starts_with("checked"));
    CHECK(body.orthogonality < 1e-9);
    // Only the free nodes have mass: the total is less that of the fixed nodes, S2 less their share
    // of it, which is zero.
    CHECK(body.invariants.mass < truth.invariants.mass);
    CHECK(body.invariants.Maa.isApprox(truth.invariants.Maa, 1e-9));
  }
}

TEST_CASE("matrices are solved by the package and the options of PETSc that are asked for") {
  ModalOptions options;
  options.mode_count = 3;
  CHECK_THAT(analyse_matrices(matrices(column()), options, {}).solver,
             Catch::StartsWith("CHOLMOD"));
  options.solver = Solver::mumps;
  options.petsc_options = "-st_mat_mumps_icntl_14 50";
  CHECK_THAT(analyse_matrices(matrices(column()), options, {}).solver, Catch::StartsWith("MUMPS"));
  options.solver = Solver::cholmod;  // CHOLMOD does not use that option of MUMPS
  CHECK_THROWS_AS(analyse_matrices(matrices(column()), options, {}), InputError);
}

TEST_CASE("matrices that do not belong together are refused") {
  ImportedBody fewer_nodes = matrices(column());
  fewer_nodes.nodes_m.conservativeResize(Eigen::NoChange, 3);
  CHECK_THROWS_AS(check(fewer_nodes), InputError);
  ImportedBody uneven = matrices(column());
  uneven.mass.coeffRef(0, 0) *= 1.001;
  CHECK_THROWS_AS(check(uneven), InputError);
  ModalOptions options;
  options.mode_count = 100000;
  CHECK_THROWS_AS(analyse_matrices(matrices(column()), options, {}), InputError);
}

}  // namespace flexneck::fe_modal
