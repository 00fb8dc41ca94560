// SPDX-License-Identifier: GPL-3.0-or-later
#include <functional>

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include "geometry/foundation/error.h"
#include "mesher/mesh/pieces.h"
#include "tests/support/block_mesh.h"

namespace flexneck::mesher {
namespace {

/// Unit cube of three parts: two layers of elements, one and one.
Mesh three_parts() {
  testing::BlockMesh block;
  block.x_divisions = 2;
  block.y_divisions = 3;
  const Material soft{"soft", 1e6, 0.45, 1000};
  const Material hard{"hard", 1e9, 0.3, 2000};
  block.slices = {{"lower", 2, hard}, {"middle", 1, soft}, {"upper", 1, hard}};
  block.position = [](const Eigen::Vector3d& p) { return p; };
  return block.make();
}

Eigen::Vector3d summed_normals(const Mesh& mesh, const FaceSet& faces) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const FaceBlock& block : faces.blocks) {
    for (std::size_t f = 0; f < block.size(); ++f) {
      const auto at = [&](std::size_t corner) {
        const std::int32_t node = block.nodes[f * nodes_per_element(block.kind) + corner];
        return Eigen::Vector3d(mesh.nodes[static_cast<std::size_t>(node)].data());
      };
      sum += (at(2) - at(0)).cross(at(3) - at(1)) / 2;
    }
  }
  return sum;
}

void require_refusal(const std::function<void()>& action, const std::string& words) {
  CHECK_THROWS_WITH(action(), Catch::Matchers::Contains(words));
}

}  // namespace

TEST_CASE("pieces cut by parts are whole meshes that meet on faces of equal nodes") {
  const Mesh whole = three_parts();
  const auto pieces =
      cut_apart(whole, pieces_by_parts(whole, {{"lower"}, {"upper", "middle"}}), {"base", "rest"});
  REQUIRE(pieces.size() == 2);
  for (const MeshPiece& piece : pieces) {
    check(piece.mesh);
    for (std::size_t n = 0; n < piece.nodes.size(); ++n) {
      CHECK(piece.mesh.nodes[n] == whole.nodes[static_cast<std::size_t>(piece.nodes[n])]);
    }
  }
  const Mesh& base = pieces[0].mesh;
  const Mesh& rest = pieces[1].mesh;
  CHECK(base.materials.size() == 1);
  CHECK(rest.materials.size() == 2);
  CHECK(base.face_sets.size() == 2);  // bottom and the cut
  CHECK(rest.face_sets.size() == 2);  // top and the cut

  const Eigen::Vector3d out_of_base = summed_normals(base, base.face_set(cut_name("rest")));
  const Eigen::Vector3d out_of_rest = summed_normals(rest, rest.face_set(cut_name("base")));
  CHECK((out_of_base - Eigen::Vector3d::UnitZ()).norm() < 1e-14);
  CHECK((out_of_rest + Eigen::Vector3d::UnitZ()).norm() < 1e-14);

  const auto in_whole = [](const MeshPiece& piece, const std::string& set) {
    std::vector<std::int32_t> nodes = piece.mesh.node_set(set).nodes;
    for (std::int32_t& node : nodes) node = piece.nodes[static_cast<std::size_t>(node)];
    return nodes;
  };
  CHECK(in_whole(pieces[0], "to_rest") == in_whole(pieces[1], "to_base"));
}

TEST_CASE("pieces cut by planes between layers of elements divide the volume") {
  const Mesh whole = three_parts();
  const PieceOfElement pieces =
      pieces_by_planes(whole, Eigen::Vector3d::UnitZ(), std::vector<double>{0.25, 0.75});
  const auto cut = cut_apart(whole, pieces, {"a", "b", "c"});
  REQUIRE(cut.size() == 3);
  CHECK(cut[1].mesh.blocks.size() == 2);  // the upper layer of one part and another part
  CHECK(cut[1].mesh.face_sets.size() == 2);
  CHECK(cut[0].mesh.blocks.front().size() == 6);
  CHECK(cut[1].mesh.face_set("to_c").blocks.front().size() == 6);
}

TEST_CASE("cuts that cannot be made are refused") {
  const Mesh whole = three_parts();
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  require_refusal(
      [&] {
        pieces_by_parts(whole, {{"lower"}, {"middle"}});
      },
      "part 'upper' belongs to no substructure");
  require_refusal(
      [&] {
        pieces_by_parts(whole, {{"lower", "upper"}, {"middle", "upper"}});
      },
      "part 'upper' belongs to two substructures");
  require_refusal([&] { pieces_by_parts(whole, {{"lover"}}); }, "lower");
  require_refusal([&] { pieces_by_planes(whole, up, std::vector<double>{0.3}); },
                  "passes through elements of part 'lower'");
  require_refusal(
      [&] {
        pieces_by_planes(whole, up, std::vector<double>{0.75, 0.25});
      },
      "ascending order");
  require_refusal(
      [&] {
        pieces_by_planes(whole, up, std::vector<double>{-1.0, 0.25});
      },
      "leave substructure 1 without elements");
}

}  // namespace flexneck::mesher
