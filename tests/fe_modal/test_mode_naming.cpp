// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include "fe_modal/reduction/mode_naming.h"
#include "tests/support/block_mesh.h"
#include "tests/support/element_choices.h"

namespace flexneck::fe_modal {
namespace {

Eigen::Matrix3Xd rigid_field(const mesher::Mesh& mesh, const Eigen::Vector3d& centre,
                             const Eigen::Vector3d& translation, const Eigen::Vector3d& rotation) {
  Eigen::Matrix3Xd field(3, static_cast<Eigen::Index>(mesh.nodes.size()));
  for (std::size_t k = 0; k < mesh.nodes.size(); ++k) {
    const Eigen::Map<const Eigen::Vector3d> x(mesh.nodes[k].data());
    field.col(static_cast<Eigen::Index>(k)) = translation + rotation.cross(x - centre);
  }
  return field;
}

}  // namespace

TEST_CASE("shares are the kinetic energies of a part's rigid motion") {
  const Eigen::Vector3d size(0.2, 0.1, 0.3);
  const mesher::Mesh mesh = testing::box({1, 1, 2}, size, kSteel).make();
  const std::vector<RigidAverage> parts = {RigidAverage(mesh, "block")};
  const Eigen::Vector3d t(0.3, -0.5, 0.2);
  const Eigen::Vector3d w(4, -3, 6);
  const Shares found = motion_shares(parts, rigid_field(mesh, Eigen::Vector3d(0, 0, 0.15), t, w));
  const auto square = [](double v) { return v * v; };
  const double fore_aft = square(t[0]) + (square(0.2) + square(0.3)) / 12 * square(w[1]);
  const double lateral = square(t[1]) + (square(0.1) + square(0.3)) / 12 * square(w[0]);
  const double twist = (square(0.2) + square(0.1)) / 12 * square(w[2]);
  const double axial = square(t[2]);
  const double sum = fore_aft + lateral + twist + axial;
  CHECK(found[0] == Approx(100 * fore_aft / sum));
  CHECK(found[1] == Approx(100 * lateral / sum));
  CHECK(found[2] == Approx(100 * twist / sum));
  CHECK(found[3] == Approx(100 * axial / sum));
}

TEST_CASE("a part that only deforms has no shares") {
  const mesher::Mesh mesh = testing::box({1, 1, 2}, {0.2, 0.1, 0.3}, kSteel).make();
  const std::vector<RigidAverage> parts = {RigidAverage(mesh, "block")};
  const auto n = static_cast<Eigen::Index>(mesh.nodes.size());
  CHECK(motion_shares(parts, Eigen::Matrix3Xd::Zero(3, n)) == Shares{});
  CHECK(motion_shares({}, Eigen::Matrix3Xd::Ones(3, n)) == Shares{});
}

TEST_CASE("modes are named by their largest share and counted by kind") {
  const std::vector<std::string> names = mode_names({{90, 0, 8, 2},
                                                     {0, 80, 20, 0},
                                                     {0, 40, 60, 0},
                                                     {70, 0, 0, 30},
                                                     {0, 0, 0, 0},
                                                     {10, 0, 0, 90},
                                                     {0, 55, 45, 0}});
  const std::vector<std::string> expected = {"fore-aft bending 1",
                                             "lateral bending 1",
                                             "torsion 1",
                                             "fore-aft bending 2",
                                             "mode 5",
                                             "axial 1",
                                             "lateral bending 2"};
  CHECK(names == expected);
}

}  // namespace flexneck::fe_modal
