// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Core>
#include <catch2/catch.hpp>

#include "fe_modal/completeness.h"
#include "fe_modal/inertia.h"
#include "fe_modal/local_system.h"
#include "fe_modal/modal_analysis.h"
#include "geometry/foundation/error.h"
#include "tests/fe_modal/dense.h"
#include "tests/support/block_mesh.h"
#include "tests/support/dense_solvers.h"

namespace flexneck::fe_modal {

TEST_CASE("inertia counts the eigenvalues of a dense solution, double ones twice") {
  const mesher::Material steel{"steel", 2.1e11, 0.3, 7850};
  for (const bool held : {true, false}) {
    const mesher::Mesh mesh = testing::box({2, 2, 2}, {0.1, 0.1, 0.3}, steel).make();
    const FreeNodes free_nodes(mesh,
                               held ? mesh.node_set("bottom").nodes : std::vector<std::int32_t>{});
    const SystemMatrices system = assemble(mesh, free_nodes);
    const Eigen::VectorXd values =
        testing::dense_pairs(dense(system.stiffness.get()), dense(system.mass.get())).values;
    if (held) REQUIRE(values[1] < values[0] * (1 + 1e-8));  // bending in both directions
    for (const Eigen::Index k : {2, 7, 12, 50}) {
      if (values[k] < values[k - 1] * (1 + 1e-6)) continue;
      if (values[k - 1] < 1e-6 * values[50] && !held && k < 6) continue;
      CHECK(eigenvalues_below(system, (values[k - 1] + values[k]) / 2) == k);
    }
    if (held) CHECK(eigenvalues_below(system, values[0] / 2) == 0);
    if (!held) CHECK(eigenvalues_below(system, values[6] / 2) == 6);
  }
}

TEST_CASE("a mode withheld is missed, wherever it stood") {
  const mesher::Mesh mesh =
      testing::box({2, 2, 4}, {0.05, 0.05, 0.3}, {"steel", 2.1e11, 0.3, 7850}).make();
  const FreeNodes free_nodes(mesh, mesh.node_set("bottom").nodes);
  const LocalSystem system(assemble(mesh, free_nodes));
  const Eigen::VectorXd values =
      lowest_eigenpairs(system.stiffness(), system.mass(), *system.shift_inverse(0), 7).values;
  CHECK(prove_complete(system, values, 5, 0).has_value());
  for (Eigen::Index withheld = 0; withheld < 5; ++withheld) {
    Eigen::VectorXd fewer(6);
    fewer << values.head(withheld), values.tail(6 - withheld);
    CHECK_THROWS_AS(prove_complete(system, fewer, 4, 0), ComputationError);
  }
}

TEST_CASE("a certified body says so and up to which frequency") {
  const mesher::Mesh mesh =
      testing::box({2, 2, 4}, {0.05, 0.05, 0.3}, {"steel", 2.1e11, 0.3, 7850}).make();
  ModalOptions options;
  options.held_set = "bottom";
  options.certify = true;
  // One of a bending pair is asked for only: there is no gap above it, so one more is looked at.
  for (const int count : {1, 2, 5}) {
    options.mode_count = count;
    const ModalBody body = analyse_modes(mesh, options, {});
    CHECK(body.frequencies_Hz.size() == count);
    CHECK_THAT(body.certificate, Catch::StartsWith("certified: no mode is missing below "));
  }
  options.held_set.clear();
  options.mode_count = 8;
  CHECK_THAT(analyse_modes(mesh, options, {}).certificate, Catch::StartsWith("certified"));
}

}  // namespace flexneck::fe_modal
