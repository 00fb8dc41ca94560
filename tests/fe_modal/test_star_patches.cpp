// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstddef>
#include <numeric>
#include <vector>

#include <catch2/catch.hpp>

#include "fe_modal/algebra/block_product.h"
#include "fe_modal/solve/assembled_system.h"
#include "fe_modal/solve/refined/star_patches.h"
#include "mesher/mesh/refinement.h"
#include "tests/support/block_mesh.h"
#include "tests/support/dense_solvers.h"
#include "tests/support/element_choices.h"
#include "tests/support/element_meshes.h"

namespace flexneck::fe_modal {
namespace {

using mesher::ElementKind;

/// The exact solutions of the stars with the assembled matrix, added up.
Eigen::MatrixXd sum_of_solutions(const Eigen::MatrixXd& stiffness, const PatchLists& stars,
                                 const std::vector<std::size_t>& chosen,
                                 const Eigen::MatrixXd& forces) {
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(forces.rows(), forces.cols());
  for (const std::size_t star : chosen) {
    std::vector<Eigen::Index> rows;
    for (const std::int32_t block : stars[star]) {
      for (Eigen::Index a = 0; a < 3; ++a) rows.push_back(3 * block + a);
    }
    sum(rows, Eigen::all) +=
        testing::symmetric_solution(stiffness(rows, rows), forces(rows, Eigen::all));
  }
  return sum;
}

/// Compares what the patches of a refined mesh find.
void check_against_assembled(const mesher::RefinedMesh& fine) {
  ModalOptions options;
  options.fixed_set = "bottom";
  const DofMap dof_map = dof_map_of(fine.mesh, options);
  const AssembledSystem system(fine.mesh, dof_map, options);
  const StarMesh body{fine.mesh, dof_map, fine.parents, {}};
  const StarPatches patches(body, {fine.mesh, dof_map, options.formulation, {}});
  const Eigen::Index size = system.fields().own_dof_count();
  const Eigen::MatrixXd stiffness =
      block_product(system.stiffness(), Eigen::MatrixXd::Identity(size, size));
  const PatchLists stars = find_stars(body);
  std::vector<std::size_t> all(stars.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  const std::vector<std::size_t> cells = find_cells(body, stars);
  const bool has_cells = fine.mesh.blocks.front().kind == ElementKind::hex27;
  CHECK(cells.size() == (has_cells ? fine.parents.size() / 8 : 0));
  for (const Eigen::Index columns : {3, 10, 17}) {
    Eigen::MatrixXd forces = Eigen::MatrixXd::Random(size, columns);
    for (Eigen::Index row = 0; row < size; ++row) {  // on dependent ones nothing acts
      if (dof_map.is_dependent(static_cast<std::int32_t>(row / 3), row % 3)) {
        forces.row(row).setZero();
      }
    }
    const auto is_near = [](const Eigen::MatrixXd& found, const Eigen::MatrixXd& truth) {
      return (found - truth).norm() < 1e-4 * truth.norm();
    };
    Eigen::MatrixXd of_stars = Eigen::MatrixXd::Zero(forces.rows(), forces.cols());
    patches.add_stars(1, forces, of_stars);
    CHECK(is_near(of_stars, sum_of_solutions(stiffness, stars, all, forces)));
    Eigen::MatrixXd of_cells = of_stars;
    patches.add_cells(-2, forces, of_cells);
    if (cells.empty()) {
      CHECK(of_cells == of_stars);
    } else {
      CHECK(is_near((of_stars - of_cells) / 2, sum_of_solutions(stiffness, stars, cells, forces)));
    }
  }
}

mesher::RefinedMesh refined(ElementKind kind) {
  const mesher::Mesh mesh = testing::box({2, 1, 1}, {0.04, 0.03, 0.02}, kRubber).make();
  return mesher::refine(testing::with_kind(mesh, kind));
}

}  // namespace

TEST_CASE("stars solve as the assembled matrix does on their nodes, also without the inner ones") {
  for (const ElementKind kind : {ElementKind::hex27, ElementKind::hex20, ElementKind::prism18,
                                 ElementKind::pyramid13, ElementKind::tet10}) {
    CAPTURE(mesher::name_of(kind));
    check_against_assembled(refined(kind));
  }
}

TEST_CASE("stars solve likewise where an inner node follows another in one direction") {
  mesher::RefinedMesh fine = refined(ElementKind::hex27);
  const std::vector<std::int32_t>& nodes = fine.mesh.blocks.front().nodes;
  const std::int32_t middle = nodes[26];
  fine.mesh.connections.equations = {{"lever", {{middle, {1, 0, 0}}, {nodes[25], {-1, 0, 0}}}}};
  check_against_assembled(fine);
}

}  // namespace flexneck::fe_modal
