// SPDX-License-Identifier: GPL-3.0-or-later
// The static step under constraints, springs and masses against dense matrices in the null space of
// all constraint equations.
#include <catch2/catch.hpp>

#include "fe_modal/analysis/modal_analysis.h"
#include "fe_modal/analysis/static_analysis.h"
#include "fe_modal/body/static_solution_file.h"
#include "geometry/foundation/error.h"
#include "geometry/foundation/temporary_folder.h"
#include "tests/fe_modal/dense_constraints.h"
#include "tests/support/block_mesh.h"

namespace flexneck::fe_modal {
namespace {

using Catch::Matchers::Contains;

const Eigen::Vector3d kGravity(0.3, -2, -9.81);
const Eigen::Vector3d kForce(3, -2, 5);

/// A block on oblique supports and springs, with a heavy body on a coupling to which a node is
/// geared.
mesher::Mesh block() {
  testing::BlockMesh box = testing::box({1, 1, 2}, {1, 1, 1}, {"rubber", 8.3e6, 0.45, 950});
  box.position = [](const Eigen::Vector3d& p) -> Eigen::Vector3d {
    return 0.3 * testing::distorted(p).cwiseProduct(Eigen::Vector3d(0.4, 0.5, 1));
  };
  mesher::Mesh mesh = box.make();
  const std::vector<std::int32_t> bottom = mesh.node_set("bottom").nodes;
  mesher::Connections& connections = mesh.connections;
  const mesher::AxisSystem oblique{
      {}, mesher::axes_from({1, 2, 3}, Eigen::Vector3d::Zero()), false};
  connections.points = {{"tip", {0.02, 0.03, 0.36}}};
  connections.couplings = {{"coupling 'tip'", 0, mesh.node_set("top").nodes}};
  connections.supports = {{"bottom", bottom, {false, true, true}, oblique}};
  const std::int32_t tip = mesher::translation_site(mesh.nodes.size(), 0);
  const std::int32_t node = bottom.back() + 5;
  connections.masses = {
      {"m", tip, 2.5, {0.05, -0.02, 0.1}, {0.02, 0.03, 0.025, 0.003, -0.002, 0.004}},
      {"at a node", node, 0.7, {}, {}}};
  connections.equations = {{"gear", {{node, {2, 0, 0}}, {tip, {-0.5, 0.1, 0}}}}};
  connections.springs = {{"to ground", {{bottom[3], {0.6, 0, 0.8}}}, 3000},
                         {"between", {{bottom[3], {0, 1, 0}}, {tip, {0, -1, 0}}}, 5000},
                         {"torsion", {{tip + 1, {0, 0, 1}}}, 40}};
  return mesh;
}

std::vector<Load> loads() {
  return {{"weight", GravityLoad{kGravity}}, {"push", NodeLoad{"top", {}, kForce}}};
}

/// Displacements of the nodes, (3, n).
Eigen::Matrix3Xd dense_displacements(const mesher::Mesh& mesh) {
  const DenseConstraints model = dense_model(mesh);
  const auto n = static_cast<Eigen::Index>(mesh.nodes.size());
  Eigen::VectorXd fall = Eigen::VectorXd::Zero(model.mass.rows());
  for (Eigen::Index node = 0; node < n; ++node) fall.segment<3>(3 * node) = kGravity;
  fall.segment<3>(3 * n) = kGravity;  // acceleration of the reference point
  Eigen::VectorXd force = model.mass * fall;
  for (const std::int32_t node : mesh.node_set("top").nodes) {
    force.segment<3>(3 * static_cast<Eigen::Index>(node)) += kForce;
  }
  const Eigen::MatrixXd basis = allowed_motions(model);
  const Eigen::VectorXd motion =
      basis * testing::symmetric_solution(basis.transpose() * model.stiffness * basis,
                                          basis.transpose() * force);
  return motion.head(3 * n).reshaped(3, n);
}

/// Resultant of the weights, from the invariants of the whole including masses at points and nodes,
/// and of the pushes.
Resultant all_loads(const mesher::Mesh& mesh) {
  ModalOptions options;
  options.mode_count = 1;
  const InertiaInvariants inertia = analyse_modes(mesh, options, {}).invariants;
  Resultant sum{inertia.mass * kGravity, inertia.S1.cross(kGravity)};
  for (const std::int32_t node : mesh.node_set("top").nodes) {
    sum.force_N += kForce;
    sum.moment_Nm += point_of(mesh.nodes[static_cast<std::size_t>(node)]).cross(kForce);
  }
  return sum;
}

}  // namespace

TEST_CASE("a static step under constraints, springs and masses is that of the null space") {
  constexpr double kSame = 1e-9;
  const mesher::Mesh mesh = block();
  const Eigen::Matrix3Xd expected = dense_displacements(mesh);
  for (const Solver solver : {Solver::cholmod, Solver::mumps}) {
    ModalOptions options;
    options.solver = solver;
    StaticSolutionFile file;
    file.solution = analyse_static(mesh, options, loads(), {});
    CHECK((file.solution.displacements_m - expected).norm() < kSame * expected.norm());
    // The resultant about the origin is that of the weight of the whole, including the mass at the
    // point, and of the pushes.
    const Resultant applied = resultant_of(file.solution.nodes_m, file.solution.applied_N);
    const Resultant reactions = resultant_of(file.solution.nodes_m, file.solution.reactions_N);
    const auto [force_N, moment_Nm] = all_loads(mesh);
    CHECK((applied.force_N - force_N).norm() < kSame * force_N.norm());
    CHECK((applied.moment_Nm - moment_Nm).norm() < kSame * moment_Nm.norm());
    CHECK((reactions.force_N + force_N).norm() < kSame * force_N.norm());
    // Readers refuse reactions that do not balance the loads.
    const TemporaryFolder folder;
    write_static_solution(folder / "static.h5", file);
    CHECK_NOTHROW(read_static_solution(folder / "static.h5"));
  }
}

TEST_CASE("what small motions of couplings and springs leave out is refused") {
  const mesher::Mesh mesh = block();
  const auto refusal = [&](auto&& analysis) -> std::string {
    try {
      analysis();
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  ModalOptions options;
  options.prestress = loads();
  CHECK_THAT(
      refusal([&] { analyse_modes(mesh, options, {}); }),
      Contains("a prestress is not supported with 1 reference point, 1 coupling, 3 springs"));
  options.prestress.clear();
  options.interfaces = {{"tip", "top"}};
  options.geometric_stiffness = true;
  CHECK_THAT(
      refusal([&] { analyse_modes(mesh, options, {}); }),
      Contains("the geometric stiffness under unit loads is not supported with 1 reference"));
  mesher::Mesh plain = mesh;
  plain.connections = {};
  options.fixed_set = "bottom";
  options.interfaces[0].is_rigid = true;
  CHECK_THAT(refusal([&] { analyse_modes(plain, options, {}); }),
             Contains("under unit loads is not supported with 1 reference point, 1 coupling"));
  ModalOptions fixed;
  fixed.fixed_directions = {{"bottom", {true, false, false}}};
  CHECK_THAT(refusal([&] {
               analyse_static(mesh, fixed, {{"lift", SupportLoad{"bottom", {1e-3, 0, 0}}}}, {});
             }),
             Contains("supports with a displacement are not possible at nodes of"));
}

}  // namespace flexneck::fe_modal
