// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <catch2/catch.hpp>

#include "fe_modal/analysis/modal_analysis.h"
#include "fe_modal/solve/assembled_system.h"
#include "fe_modal/solve/inertia.h"
#include "fe_modal/solve/sturm_check.h"
#include "geometry/foundation/error.h"
#include "tests/fe_modal/dense.h"
#include "tests/support/block_mesh.h"
#include "tests/support/dense_solvers.h"

namespace flexneck::fe_modal {

TEST_CASE("inertia counts the eigenvalues of a dense solution, double ones twice") {
  const mesher::Material steel{"steel", 2.1e11, 0.3, 7850};
  for (const bool fixed : {true, false}) {
    const mesher::Mesh mesh = testing::box({2, 2, 2}, {0.1, 0.1, 0.3}, steel).make();
    const DofMap dof_map(mesh, fixed ? mesh.node_set("bottom").nodes : std::vector<std::int32_t>{});
    const SystemMatrices matrices = assemble(mesh, dof_map);
    ModalOptions options;
    if (fixed) options.fixed_set = "bottom";
    const Model model(mesh, options);
    const AssembledSystem system(model);
    const auto count_below = [&](double sigma) {
      return negative_eigenvalues(shifted_stiffness(system.stiffness(), system.mass(), sigma).get(),
                                  {});
    };
    const Eigen::VectorXd values =
        testing::dense_pairs(dense(matrices.stiffness.get()), dense(matrices.mass.get())).values;
    if (fixed) REQUIRE(values[1] < values[0] * (1 + 1e-8));  // bending modes in both directions
    for (const Eigen::Index k : {2, 7, 12, 50}) {
      if (values[k] < values[k - 1] * (1 + 1e-6)) continue;
      if (values[k - 1] < 1e-6 * values[50] && !fixed && k < 6) continue;
      CHECK(count_below((values[k - 1] + values[k]) / 2) == k);
    }
    if (fixed) CHECK(count_below(values[0] / 2) == 0);
    if (!fixed) CHECK(count_below(values[6] / 2) == 6);
  }
}

TEST_CASE("a mode withheld is missed, wherever it stood") {
  const mesher::Mesh mesh =
      testing::box({2, 2, 4}, {0.05, 0.05, 0.3}, {"steel", 2.1e11, 0.3, 7850}).make();
  ModalOptions options;
  options.fixed_set = "bottom";
  const Model model(mesh, options);
  const AssembledSystem system(model);
  const EigenPairs pairs = lowest_eigenpairs(system.mass(), *shift_inverse(system, 0), 7);
  CHECK(check_complete(system, pairs, 5, 0).has_value());
  for (Eigen::Index withheld = 0; withheld < 5; ++withheld) {
    std::vector<Eigen::Index> others(7);
    std::iota(others.begin(), others.end(), 0);
    others.erase(others.begin() + withheld);
    const EigenPairs fewer{pairs.values(others), pairs.vectors(Eigen::all, others)};
    CHECK_THROWS_AS(check_complete(system, fewer, 4, 0), ComputationError);
  }
}

TEST_CASE(
    "what is said of completeness is true of the modes that the body has, whatever the count "
    "cuts") {
  const mesher::Mesh mesh =
      testing::box({1, 1, 3}, {0.05, 0.05, 0.3}, {"steel", 2.1e11, 0.3, 7850}).make();
  ModalOptions options;
  options.check = true;
  for (const bool fixed : {true, false}) {
    options.fixed_set = fixed ? "bottom" : "";
    const DofMap dof_map = dof_map_of(mesh, options);
    const SystemMatrices system = assemble(mesh, dof_map);
    const Eigen::VectorXd truth_Hz =
        testing::dense_pairs(dense(system.stiffness.get()), dense(system.mass.get()))
            .values.cwiseMax(0)
            .cwiseSqrt() /
        (2 * std::numbers::pi);
    for (int count = 1; count <= 9; ++count) {
      options.mode_count = count;
      std::vector<std::string> warnings;
      const auto warn = [&](const std::string& line) { warnings.push_back(line); };
      const ModalBody body = analyse_modes(mesh, options, {}, nullptr, warn);
      INFO("fixed " << fixed << ", " << count << " modes: " << body.completeness);
      REQUIRE(body.frequencies_Hz.size() == count);
      const std::string claim = "no mode is missing below ";
      const std::size_t at = body.completeness.find(claim);
      if (at != std::string::npos) {
        const double below_Hz = std::stod(body.completeness.substr(at + claim.size()));
        CHECK((body.frequencies_Hz.array() < below_Hz).count() ==
              (truth_Hz.array() < below_Hz).count());
      }
      const bool cuts = fixed ? truth_Hz[count] < truth_Hz[count - 1] * (1 + 1e-6)
                              : count < 6 || truth_Hz[count] < truth_Hz[count - 1] * (1 + 1e-6);
      CHECK(cuts ==
            (body.completeness.find("the number of modes splits the ") != std::string::npos));
      CHECK(warnings.size() == (cuts ? 1 : 0));
      CHECK(body.completeness.starts_with(at == std::string::npos ? "not checked" : "checked"));
      // The first pair, and rigid-body motions, have no complete modes below them.
      CHECK((at == std::string::npos) == (fixed ? count == 1 : count < 6));
    }
  }
}

TEST_CASE("without the check, too, a count that cuts a cluster is warned about") {
  const mesher::Mesh mesh =
      testing::box({1, 1, 3}, {0.05, 0.05, 0.3}, {"steel", 2.1e11, 0.3, 7850}).make();
  const auto warnings_of = [&](int count, const std::string& fixed, Solver solver) {
    ModalOptions options;
    options.mode_count = count;
    options.fixed_set = fixed;
    options.solver = solver;
    std::string lines;
    const ModalBody body =
        analyse_modes(mesh, options, {}, nullptr, [&](const std::string& line) { lines += line; });
    CHECK(body.completeness == "not checked");
    return lines;
  };
  for (const Solver solver : {Solver::cholmod, Solver::mumps}) {
    CHECK_THAT(
        warnings_of(1, "bottom", solver),
        Catch::Contains("the number of modes, 1, splits a cluster of equal frequencies at "));
    CHECK(warnings_of(2, "bottom", solver).empty());
    CHECK_THAT(warnings_of(3, "", solver), Catch::Contains("request at least 6"));
    CHECK(warnings_of(6, "", solver).empty());
    CHECK_THAT(warnings_of(7, "", solver), Catch::Contains("or only 6"));
  }
}

TEST_CASE("all modes that a body has are found and told as all") {
  const mesher::Mesh mesh =
      testing::box({1, 1, 1}, {0.05, 0.06, 0.07}, {"steel", 2.1e11, 0.3, 7850}).make();
  ModalOptions options;
  options.fixed_set = "bottom";
  options.check = true;
  options.mode_count = 54;
  const ModalBody body = analyse_modes(mesh, options, {});
  CHECK(body.completeness == "checked: all modes of the structure were found");
  // A finer mesh either has the shape or lacks it, for modes within the element as well.
  for (const ModeRecord& mode : body.modes) {
    REQUIRE(mode.mesh_error);
    CHECK((mode.mesh_error->mac >= 0 && mode.mesh_error->mac <= 1 + 1e-9));
    CHECK((mode.mesh_error->error >= 0 && std::isfinite(mode.mesh_error->error)));
    CHECK(mode.mesh_error->refined_Hz > 0);
  }
}

TEST_CASE("eigenvalues that are no numbers, or negative beyond rounding, are refused") {
  const double nan = std::nan("");
  CHECK_NOTHROW(check_eigenvalues(Eigen::Vector3d(-1e-7, 0, 1), 0));
  CHECK_NOTHROW(check_eigenvalues(Eigen::Vector3d(-1, 0, 1), -2e6));
  CHECK_THROWS_WITH(check_eigenvalues(Eigen::Vector3d(-1e-3, 0, 1), 0),
                    Catch::Contains("eigenvalue 1 is -0.001 1/s^2"));
  CHECK_THROWS_WITH(check_eigenvalues(Eigen::Vector3d(-1e-3, nan, 1), -1e6),
                    Catch::Contains("eigenvalue 2 is"));
  CHECK_THROWS_AS(check_eigenvalues(Eigen::Vector3d(1, 2, HUGE_VAL), 0), ComputationError);
}

}  // namespace flexneck::fe_modal
