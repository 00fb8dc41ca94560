// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "fe_modal/algebra/block_product.h"
#include "fe_modal/algebra/random_block.h"
#include "fe_modal/solve/eigensolver.h"
#include "fe_modal/solve/refined/refined_modes.h"
#include "mesher/mesh/refinement.h"
#include "tests/support/block_mesh.h"
#include "tests/support/element_meshes.h"

namespace flexneck::fe_modal {
namespace {

using mesher::ElementKind;

/// A steel plate on a bonded rubber pad.
mesher::Mesh pad(ElementKind kind, double poissons_ratio) {
  testing::BlockMesh block = testing::box({2, 2, 1}, {0.08, 0.08, 0.03}, {});
  block.slices = {{"pad", 2, {"rubber", 8.3e6, poissons_ratio, 950}},
                  {"plate", 1, {"steel", 2.1e11, 0.3, 7850}}};
  return testing::with_kind(block.make(), kind);
}

ModalOptions fixed_at_bottom() {
  ModalOptions options;
  options.fixed_set = "bottom";
  return options;
}

/// A mesh and its refinement.
struct Pair {
  Pair(const mesher::Mesh& mesh, const ModalOptions& options)
      : dof_map(dof_map_of(mesh, options)),
        coarse(mesh, dof_map, options),
        inverse(coarse.shift_inverse(0)),
        fine(mesher::refine(mesh)),
        fine_dof_map(dof_map_of(fine.mesh, options)),
        refined(coarse, *inverse, fine, fine_dof_map, options),
        assembled(fine.mesh, fine_dof_map, options) {}

  DofMap dof_map;
  AssembledSystem coarse;
  std::unique_ptr<const ShiftInverse> inverse;
  mesher::RefinedMesh fine;
  DofMap fine_dof_map;
  RefinedSystem refined;
  AssembledSystem assembled;  ///< of the refined mesh
};

double relative_difference(const Eigen::MatrixXd& one, const Eigen::MatrixXd& other) {
  return (one - other).norm() / other.norm();
}

/// A pad whose upper side follows a point with a mass, beside an equation and a spring.
mesher::Mesh constrained_pad() {
  mesher::Mesh mesh = pad(ElementKind::hex20, 0.49);
  const auto is_in = [&](const std::string& set, std::int32_t node) {
    const std::vector<std::int32_t>& nodes = mesh.node_set(set).nodes;
    return std::binary_search(nodes.begin(), nodes.end(), node);
  };
  std::vector<std::int32_t> free;
  for (std::int32_t node = 0; node < static_cast<std::int32_t>(mesh.nodes.size()); ++node) {
    if (!is_in("top", node) && !is_in("bottom", node)) free.push_back(node);
  }
  mesher::Connections& connections = mesh.connections;
  connections.points = {{"tip", {0, 0, 0.05}}};
  connections.couplings = {{"tip", 0, mesh.node_set("top").nodes}};
  connections.equations = {{"lever", {{free.front(), {1, 0.5, 0}}, {free.back(), {-2, 0, 0}}}}};
  connections.springs = {{"spring", {{free[1], {1, 2, 0}}}, 1e5}};
  connections.masses = {{"mass", static_cast<std::int32_t>(mesh.nodes.size()), 0.3}};
  return mesh;
}

}  // namespace

TEST_CASE("products element by element are those of the assembled matrices, constraints included") {
  std::vector<mesher::Mesh> meshes = {constrained_pad()};
  for (const ElementKind kind : {ElementKind::hex27, ElementKind::prism15, ElementKind::tet10,
                                 ElementKind::pyramid13, ElementKind::tet4}) {
    meshes.push_back(pad(kind, 0.4999));
  }
  for (const mesher::Mesh& mesh : meshes) {
    CAPTURE(mesher::name_of(mesh.blocks.front().kind));
    ModalOptions options = fixed_at_bottom();
    if (mesh.blocks.front().kind == ElementKind::tet4) {
      options.formulation.of_others = Formulation::displacement;
    }
    const Pair pair(mesh, options);
    // A field of the finer mesh that the constraints allow.
    Eigen::MatrixXd columns = random_block(pair.coarse.mass(), 5, 1);
    columns = pair.refined.prolonged(columns);
    const ElementOperator::Products products = pair.refined.products(columns);
    CHECK(relative_difference(products.forces, block_product(pair.assembled.stiffness(), columns)) <
          1e-12);
    CHECK(relative_difference(products.momenta, block_product(pair.assembled.mass(), columns)) <
          1e-12);
  }
}

TEST_CASE("forces go to the mesh before by the transpose of what carries fields to the finer one") {
  const Pair pair(constrained_pad(), fixed_at_bottom());
  const MeshTransfer transfer(pair.coarse.fields(), pair.refined.fields(), pair.fine.prolongation);
  Eigen::MatrixXd fields = random_block(pair.coarse.mass(), 3, 1);
  for (std::int32_t block = 0; block < pair.dof_map.free_count(); ++block) {
    for (Eigen::Index a = 0; a < 3; ++a) {
      if (pair.dof_map.is_dependent(block, a)) fields.row(3 * block + a).setZero();
    }
  }
  const Eigen::MatrixXd forces = random_block(pair.assembled.mass(), 3, 2);
  Eigen::MatrixXd carried(forces.rows(), forces.cols());
  transfer.to_fine(fields, carried);
  const Eigen::MatrixXd one = forces.transpose() * carried;
  const Eigen::MatrixXd other = transfer.to_coarse(forces).transpose() * fields;
  CHECK(relative_difference(one, other) < 1e-13);
}

TEST_CASE("the finer modes are within a third of their change of those by a factor") {
  struct Case {
    ElementKind kind;
    double poissons_ratio;
    Formulation formulation = Formulation::mixed_pressure;
    double found = 0.95;  ///< of the change, at least
  };
  for (const Case& each : {Case{ElementKind::hex27, 0.49}, Case{ElementKind::hex27, 0.4999},
                           Case{ElementKind::prism18, 0.49}, Case{ElementKind::tet10, 0.49},
                           Case{ElementKind::hex20, 0.49}, Case{ElementKind::hex20, 0.495},
                           Case{ElementKind::hex20, 0.49, Formulation::reduced, 0.93},
                           Case{ElementKind::tet10, 0.49, Formulation::displacement}}) {
    CAPTURE(mesher::name_of(each.kind), each.poissons_ratio, name_of(each.formulation));
    constexpr Eigen::Index kCount = 4;
    ModalOptions options = fixed_at_bottom();
    options.formulation.of_others = each.formulation;
    const Pair pair(pad(each.kind, each.poissons_ratio), options);
    const EigenPairs coarse = lowest_eigenpairs(pair.coarse.mass(), *pair.inverse, kCount);
    const RefinedModes modes = refined_modes(pair.refined, coarse, 0);
    const EigenPairs truth =
        lowest_eigenpairs(pair.assembled.mass(), *pair.assembled.shift_inverse(0), kCount);
    for (Eigen::Index k = 0; k < kCount; ++k) {
      const double change = std::abs(truth.values[k] - coarse.values[k]);
      CHECK(modes.values[k] >= truth.values[k] * (1 - 1e-9));
      CHECK(std::abs(modes.values[k] - modes.excess[k] - truth.values[k]) < change / 3);
      const double found = std::max(std::abs(modes.values[k] - coarse.values[k]),
                                    std::abs(modes.values[k] - modes.excess[k] - coarse.values[k]));
      CHECK(found > each.found * change);
    }
  }
}

}  // namespace flexneck::fe_modal
