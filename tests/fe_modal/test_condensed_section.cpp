// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include "fe_modal/analysis/modal_analysis.h"
#include "fe_modal/body/condensed_section.h"
#include "fe_modal/body/skew.h"
#include "geometry/foundation/error.h"
#include "mesher/mesh/pieces.h"
#include "tests/support/block_mesh.h"
#include "tests/support/dense_solvers.h"
#include "tests/support/neck_mesh.h"

namespace flexneck::fe_modal {
namespace {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;
using Vector12d = Eigen::Matrix<double, 12, 1>;

/// Options for the static shapes of "top" alone, with "bottom" fixed.
ModalOptions section_options(const std::string& bottom, const Eigen::Vector3d& base_m,
                             const std::string& top, const Eigen::Vector3d& top_m) {
  ModalOptions options;
  options.basis = BasisKind::craig_bampton;
  options.mode_count = 0;
  options.fixed_set = bottom;
  options.fixed_interface = "base";
  options.fixed_position_m = base_m;
  options.interfaces = {{"top", top, top_m}};
  return options;
}

/// Motions of both faces as one rigid body.
Vector12d rigid_motion(const CondensedSection& section, const Eigen::Vector3d& translation,
                       const Eigen::Vector3d& rotation) {
  Vector12d motion;
  motion << translation + rotation.cross(section.base_m), rotation,
      translation + rotation.cross(section.top_m), rotation;
  return motion;
}

/// Frequencies of a chain of sections whose first base is fixed.
Eigen::VectorXd chain_frequencies_Hz(const std::vector<CondensedSection>& chain) {
  const auto size = static_cast<Eigen::Index>(6 * (chain.size() + 1));
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(size, size);
  Eigen::MatrixXd mass = stiffness;
  for (std::size_t k = 0; k < chain.size(); ++k) {
    const auto at = static_cast<Eigen::Index>(6 * k);
    stiffness.block<12, 12>(at, at) += chain[k].stiffness;
    mass.block<12, 12>(at, at) += chain[k].mass;
  }
  const Eigen::Index free = size - 6;
  return testing::dense_pairs(stiffness.bottomRightCorner(free, free),
                              mass.bottomRightCorner(free, free))
             .values.cwiseSqrt() /
         (2 * std::numbers::pi);
}

}  // namespace

TEST_CASE("a section of a slender bar is a beam element between two faces") {
  // With a Poisson's ratio of zero the faces do not constrain the cross section's shape.
  const mesher::Material material{"steel", 2e11, 0, 7800};
  constexpr double kLength = 0.4;
  constexpr double kDepth = 0.02;  // along x
  constexpr double kWidth = 0.01;  // along y
  testing::BlockMesh block;
  block.slices = {{"bar", 32, material}};
  block.position = [](const Eigen::Vector3d& p) {
    return Eigen::Vector3d((p[0] - 0.5) * kDepth, (p[1] - 0.5) * kWidth, p[2] * kLength);
  };
  const ModalBody body =
      analyse_modes(block.make(), section_options("bottom", {0, 0, 0}, "top", {0, 0, kLength}), {});
  const CondensedSection section = condense(body, "base", "top");

  const double area = kDepth * kWidth;
  const double axial = material.youngs_modulus_Pa * area / kLength;
  CHECK(section.stiffness(8, 8) == Approx(axial).epsilon(1e-9));
  CHECK(section.stiffness(2, 8) == Approx(-axial).epsilon(1e-9));

  // Expected values are Timoshenko's beam with the shear coefficient 5/6.
  const double second_moment = kWidth * kDepth * kDepth * kDepth / 12;
  const double bending = material.youngs_modulus_Pa * second_moment;
  const double shear = 5.0 / 6 * material.youngs_modulus_Pa / 2 * area;
  const double phi = 12 * bending / (shear * kLength * kLength);
  const double transverse = 12 * bending / (std::pow(kLength, 3) * (1 + phi));
  constexpr double kClampedFaces = 1e-3;  // warping is fixed at the base
  CHECK(section.stiffness(6, 6) == Approx(transverse).epsilon(kClampedFaces));
  CHECK(section.stiffness(6, 10) == Approx(-transverse * kLength / 2).epsilon(kClampedFaces));
  CHECK(section.stiffness(0, 6) == Approx(-transverse).epsilon(kClampedFaces));

  // Rigid motions have no force, and the whole mass and inertia.
  for (int direction = 0; direction < 6; ++direction) {
    const Vector6d unit = Vector6d::Unit(direction);
    const Vector12d motion = rigid_motion(section, unit.head<3>(), unit.tail<3>());
    CHECK((section.stiffness * motion).norm() < 1e-9 * section.stiffness.norm() * motion.norm());
    const double expected =
        direction < 3 ? body.invariants.mass : body.invariants.J0(direction - 3, direction - 3);
    CHECK(motion.dot(section.mass * motion) == Approx(expected).epsilon(1e-9));
  }
}

namespace {

/// Sections of the neck, each a rubber disc with the plate above it.
std::vector<CondensedSection> sections_of(const mesher::Mesh& neck) {
  const std::vector<std::string> names = {"one", "two", "three", "four"};
  const auto pieces =
      mesher::cut_apart(neck,
                        mesher::pieces_by_parts(neck, {{"base_plate", "rubber_1", "plate_1"},
                                                       {"rubber_2", "plate_2"},
                                                       {"rubber_3", "plate_3"},
                                                       {"rubber_4", "top_plate"}}),
                        names);
  std::vector<CondensedSection> chain;
  double base_z = 0;
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    const mesher::Mesh& mesh = pieces[k].mesh;
    const std::string fixed = k == 0 ? "bolts" : mesher::cut_name(names[k - 1]);
    const std::string top = k + 1 == names.size() ? "top" : mesher::cut_name(names[k + 1]);
    const auto node = static_cast<std::size_t>(mesh.node_set(top).nodes.front());
    const double top_z = mesh.nodes[node][2];
    chain.push_back(condense(
        analyse_modes(mesh, section_options(fixed, {0, 0, base_z}, top, {0, 0, top_z}), {}), "base",
        "top"));
    base_z = top_z;
  }
  return chain;
}

Eigen::VectorXd six_frequencies_Hz(const mesher::Mesh& neck) {
  ModalOptions options;
  options.mode_count = 6;
  options.fixed_set = "bolts";
  return analyse_modes(neck, options, {}).frequencies_Hz;
}

/// Mass matrix of a lumped mass about a point, 6 x 6.
Matrix6d mass_about_point(const LumpedMass& mass) {
  Matrix6d matrix;
  matrix << mass.mass_kg * Eigen::Matrix3d::Identity(), -skew(mass.first_moment_kg_m),
      skew(mass.first_moment_kg_m), mass.inertia_kg_m2;
  return matrix;
}

/// Sections with their mass lumped in rigid plates between them.
std::vector<CondensedSection> with_lumped_masses(std::vector<CondensedSection> chain) {
  for (CondensedSection& section : chain) {
    const auto ends = lumped_masses(section);
    section.mass.setZero();
    section.mass.topLeftCorner<6, 6>() = mass_about_point(ends[0]);
    section.mass.bottomRightCorner<6, 6>() = mass_about_point(ends[1]);
  }
  return chain;
}

}  // namespace

TEST_CASE("a chain of condensed sections has the modes of the whole neck within one per cent") {
  const mesher::Mesh neck = testing::neck_mesh("C");
  const std::vector<CondensedSection> chain = sections_of(neck);
  const Eigen::VectorXd expected = six_frequencies_Hz(neck);
  const Eigen::VectorXd found = chain_frequencies_Hz(chain);
  const Eigen::VectorXd lumped = chain_frequencies_Hz(with_lumped_masses(chain));
  for (Eigen::Index k = 0; k < expected.size(); ++k) {
    CAPTURE(k, expected[k], found[k], lumped[k]);
    CHECK(std::abs(found[k] / expected[k] - 1) < 0.01);
    CHECK(std::abs(lumped[k] / expected[k] - 1) < (k < 5 ? 0.01 : 0.015));  // second torsion mode
  }
}

TEST_CASE("the lumped masses of a section have the mass, centre and inertia of the whole") {
  testing::BlockMesh block;
  block.slices = {{"foot", 2, {"steel", 2e11, 0.3, 7800}}, {"bar", 2, {"rubber", 1e7, 0.4, 1000}}};
  block.position = testing::distorted;
  const mesher::Mesh mesh = block.make();
  const ModalBody body =
      analyse_modes(mesh, section_options("bottom", {0.2, 0, 0}, "top", {0, 0.1, 1}), {});
  const CondensedSection section = condense(body, "base", "top");
  const auto ends = lumped_masses(section);
  const InertiaInvariants& whole = body.invariants;
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
  const std::array points = {section.base_m, section.top_m};
  for (std::size_t k = 0; k < 2; ++k) {
    // J about the point p, from that about the origin, is J + 2 (p . s) - (p s^T + s p^T) + m (p .
    // p - p p^T).
    const Eigen::Vector3d& p = points[k];
    const Eigen::Vector3d& s = ends[k].first_moment_kg_m;
    CHECK(ends[k].mass_kg > 0);
    moment += s + ends[k].mass_kg * p;
    inertia += ends[k].inertia_kg_m2 - skew(p) * skew(s) - skew(s) * skew(p) -
               ends[k].mass_kg * skew(p) * skew(p);
  }
  CHECK(ends[0].mass_kg + ends[1].mass_kg == Approx(whole.mass).epsilon(1e-9));
  CHECK((moment - whole.S1).norm() < 1e-9 * whole.S1.norm());
  CHECK((inertia - whole.J0).norm() < 1e-9 * whole.J0.norm());
}

TEST_CASE("a face of rubber warps, one of a steel cap moves as a rigid one") {
  const mesher::Material rubber{"rubber", 1e7, 0.4, 1000};
  const auto warp_of = [&](const std::vector<testing::Slice>& slices) {
    testing::BlockMesh block;
    block.slices = slices;
    block.position = [](const Eigen::Vector3d& p) { return p; };
    const mesher::Mesh mesh = block.make();
    const ModalBody body =
        analyse_modes(mesh, section_options("bottom", {0.5, 0.5, 0}, "top", {0.5, 0.5, 1}), {});
    std::vector<Eigen::Index> nodes;
    for (const std::size_t node : mesher::nodes_of(mesh.face_set("top")).nodes)
      nodes.push_back(static_cast<Eigen::Index>(node));
    return warp_of_face(body, "top", nodes);
  };
  CHECK(warp_of({{"bar", 2, rubber}}) > 0.05);
  CHECK(warp_of({{"bar", 2, rubber}, {"cap", 2, {"steel", 2e11, 0.3, 7800}}}) < 1e-3);
}

TEST_CASE("a body with other modes is no section") {
  testing::BlockMesh block;
  block.slices = {{"bar", 2, {"steel", 2e11, 0.3, 7800}}};
  block.position = [](const Eigen::Vector3d& p) { return p; };
  ModalOptions options = section_options("bottom", {0, 0, 0}, "top", {0, 0, 1});
  options.basis = BasisKind::normal;
  options.mode_count = 5;
  const mesher::Mesh mesh = block.make();
  CHECK_THROWS_WITH(condense(analyse_modes(mesh, options, {}), "base", "top"),
                    Catch::Matchers::Contains("6 modes") && Catch::Matchers::Contains("found 5"));
}

}  // namespace flexneck::fe_modal
