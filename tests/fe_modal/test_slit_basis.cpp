// SPDX-License-Identifier: GPL-3.0-or-later
// A block of rubber with a slit from its front to its middle: with the slit shut it is the whole
// block, with the slit open the cracked one.
#include <algorithm>
#include <numbers>
#include <random>

#include <Eigen/Dense>
#include <catch2/catch.hpp>

#include "fe_modal/analysis/modal_analysis.h"
#include "fe_modal/body/condensed_section.h"
#include "fe_modal/body/gap_coordinates.h"
#include "geometry/foundation/error.h"
#include "mesher/slits/slits.h"
#include "tests/support/block_mesh.h"
#include "tests/support/crack_faces.h"

namespace flexneck::fe_modal {
namespace {

using Eigen::MatrixXd;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

constexpr double kHeight = 0.02;
constexpr double kDepth = 0.06;
const mesher::Material kRubber{
    .name = "rubber", .youngs_modulus_Pa = 8e6, .poissons_ratio = 0.49, .density_kg_m3 = 950};

mesher::Mesh slit_block(bool tied) {
  mesher::Mesh mesh = testing::box({6, 4, 4}, {kDepth, 0.08, kHeight}, kRubber).make();
  mesh.face_sets.push_back(testing::crack_faces(mesh, "slit", [](const Eigen::Vector3d& x) {
    return std::abs(x.z() - kHeight / 2) < 1e-9 && x.x() > -1e-9;
  }));
  mesher::open_slits(mesh, {"slit"}, tied);
  return mesh;
}

ModalOptions options_with(SlitMotions motions) {
  ModalOptions options;
  options.basis = BasisKind::craig_bampton;
  options.mode_count = 0;
  options.fixed_set = "bottom";
  options.fixed_interface = "base";
  options.interfaces = {{"top", "top", {0, 0, kHeight}}};
  options.slit_motions = motions;
  return options;
}

ModalBody block(SlitMotions motions, bool tied = false) {
  return analyse_modes(slit_block(tied), options_with(motions), {});
}

MatrixXd top_stiffness(const ModalBody& body) {
  const MatrixXd stiffness = condense(body, "base", "top").stiffness;
  const Eigen::Index size = stiffness.rows() - 6;
  return stiffness.bottomRightCorner(size, size);
}

/// Compliance of the top with unloaded openings.
Matrix6d open_compliance(const MatrixXd& stiffness) {
  return stiffness.inverse().topLeftCorner<6, 6>();
}

/// Displacement of the slit's upper side along the normals relative to the lower one, (p, m).
MatrixXd openings_of_modes(const ModalBody& body, const mesher::Mesh& mesh) {
  const mesher::Slit& slit = mesh.slits.front();
  MatrixXd openings(static_cast<Eigen::Index>(slit.upper.size()), body.mode_count());
  for (Eigen::Index k = 0; k < body.mode_count(); ++k) {
    const auto& shape = body.shapes[static_cast<std::size_t>(k)];
    openings.col(k) =
        (shape(2, slit.upper) - shape(2, slit.lower)).transpose() * slit.normals[0][2];
  }
  return openings;
}

}  // namespace

TEST_CASE("a slit that is shut is none, to the last digits of the stiffness and mass") {
  const auto motions = GENERATE(SlitMotions::openings, SlitMotions::openings_and_sliding);
  const CondensedSection shut = condense(block(motions), "base", "top");
  const CondensedSection bonded = condense(block(SlitMotions::none, true), "base", "top");
  REQUIRE(shut.stiffness.rows() == 14);
  const auto motion_part = shut.stiffness.topLeftCorner<12, 12>();
  if (motions == SlitMotions::openings) {
    CHECK((motion_part - bonded.stiffness).norm() < 1e-8 * bonded.stiffness.norm());
    CHECK((shut.mass - bonded.mass).norm() < 1e-8 * bonded.mass.norm());
  } else {
    // Sliding softens only, here the shear and the torsion of the block.
    const MatrixXd softer = bonded.stiffness - motion_part;
    CHECK(softer.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff() >
          -1e-8 * bonded.stiffness.norm());
    CHECK(motion_part(6, 6) < 0.9 * bonded.stiffness(6, 6));
    CHECK(motion_part(11, 11) < 0.9 * bonded.stiffness(11, 11));
  }
}

TEST_CASE("a slit that loads pull open is a crack") {
  const Matrix6d crack = open_compliance(top_stiffness(block(SlitMotions::none)));
  const Matrix6d sliding = open_compliance(top_stiffness(block(SlitMotions::openings_and_sliding)));
  const Matrix6d stuck = open_compliance(top_stiffness(block(SlitMotions::openings)));
  const Matrix6d bonded = open_compliance(top_stiffness(block(SlitMotions::none, true)));
  for (Eigen::Index k = 0; k < 6; ++k) {
    CAPTURE(k, bonded(k, k), stuck(k, k), sliding(k, k), crack(k, k));
    // Jumps between the sides are restricted to some fields: the block is never softer than with
    // the crack.
    CHECK(sliding(k, k) <= crack(k, k) * (1 + 1e-8));
    CHECK(stuck(k, k) <= sliding(k, k) * (1 + 1e-8));
    CHECK(bonded(k, k) <= stuck(k, k) * (1 + 1e-8));
    CHECK(sliding(k, k) == Approx(crack(k, k)).epsilon(0.03));
  }
  // Bending opens the slit, which is by far its largest effect.
  CHECK(crack(4, 4) > 1.5 * bonded(4, 4));
  CHECK(stuck(4, 4) == Approx(crack(4, 4)).epsilon(0.05));
}

TEST_CASE("openings are the edges of all that keeps the sides of a slit apart") {
  const ModalBody body = block(SlitMotions::openings);
  REQUIRE(body.slits.size() == 2);
  MatrixXd motions(8, 8);
  motions << body.interface("top").translation, body.interface("top").rotation,
      body.slits[0].amplitude, body.slits[1].amplitude;
  const MatrixXd openings =
      openings_of_modes(body, slit_block(false)) * motions.inverse().rightCols<2>();
  constexpr double kTip = 1e-3;
  for (Eigen::Index k = 0; k < 2; ++k) {
    CHECK(openings.col(k).maxCoeff() > 0.9);
    CHECK(openings.col(k).minCoeff() > -kTip);
  }
  // Beyond an edge of the cone the sides overlap.
  CHECK((openings.col(0) - 0.05 * openings.col(1)).minCoeff() < -3 * kTip);
  CHECK((openings.col(1) - 0.05 * openings.col(0)).minCoeff() < -3 * kTip);
  // Without a motion of the top only the slit's stiffness resists the openings.
  const MatrixXd stiffness = top_stiffness(body);
  CHECK(stiffness.bottomRightCorner<2, 2>().selfadjointView<Eigen::Lower>().eigenvalues()[0] > 0);
}

TEST_CASE("sides whose sliding is kept, and that no load holds, are sides that slide freely") {
  const ModalBody body = block(SlitMotions::openings_and_sliding);
  const CondensedSection free = condense(body, "base", "top");
  const CondensedSection kept = condense(body, "base", "top", Sliding::kept);
  REQUIRE(kept.slides > 0);
  REQUIRE(kept.stiffness.rows() == free.stiffness.rows() + kept.slides);
  const Eigen::Index n = free.stiffness.rows();
  const MatrixXd to_slides = kept.stiffness.bottomLeftCorner(kept.slides, n);
  const MatrixXd released =
      kept.stiffness.topLeftCorner(n, n) -
      to_slides.transpose() *
          kept.stiffness.bottomRightCorner(kept.slides, kept.slides).llt().solve(to_slides);
  CHECK((released - free.stiffness).norm() < 1e-9 * free.stiffness.norm());
  CHECK_THROWS_WITH(condense(block(SlitMotions::openings), "base", "top", Sliding::kept),
                    Catch::Matchers::Contains("openings-and-sliding"));
}

TEST_CASE("with its openings as coordinates a body is the bonded one, and the open one") {
  const auto motions = GENERATE(SlitMotions::openings, SlitMotions::openings_and_sliding);
  ModalOptions options = options_with(motions);
  options.basis = BasisKind::residual;
  options.mode_count = 4;
  const GapBody found = with_gap_coordinates(analyse_modes(slit_block(false), options, {}));
  const ModalBody& shut = found.modes;
  REQUIRE(shut.mode_count() == 10);
  REQUIRE(found.stiffness.rows() == 2);
  CHECK((shut.invariants.Maa - MatrixXd::Identity(10, 10)).norm() < 1e-9);

  // The shut slit leaves the modes and the compliance of the body without a slit; sides that slide
  // soften it.
  options.slit_motions = SlitMotions::none;
  const ModalBody bonded = analyse_modes(slit_block(true), options, {});
  const auto compliance = [](const ModalBody& body) -> Matrix6d {
    Eigen::Matrix<double, 6, Eigen::Dynamic> top(6, body.mode_count());
    top << body.interface("top").translation, body.interface("top").rotation;
    const Eigen::VectorXd omega = 2 * std::numbers::pi * body.frequencies_Hz;
    return top * omega.cwiseAbs2().cwiseInverse().asDiagonal() * top.transpose();
  };
  if (motions == SlitMotions::openings) {
    for (Eigen::Index k = 0; k < 4; ++k)
      CHECK(shut.frequencies_Hz[k] == Approx(bonded.frequencies_Hz[k]).epsilon(1e-8));
    CHECK((compliance(shut) - compliance(bonded)).norm() < 1e-8 * compliance(bonded).norm());
    const InertiaInvariants& a = shut.invariants;
    const InertiaInvariants& b = bonded.invariants;
    for (std::size_t k = 0; k < 4; ++k) {  // equal up to the signs of modes
      CHECK(a.G[k * 10 + k].norm() == Approx(b.G[k * 10 + k].norm()).epsilon(1e-7));
      CHECK(a.S2.col(static_cast<Eigen::Index>(k)).norm() ==
            Approx(b.S2.col(static_cast<Eigen::Index>(k)).norm()).margin(1e-9));
    }
  } else {
    CHECK(shut.frequencies_Hz[0] < bonded.frequencies_Hz[0] * (1 + 1e-9));
  }

  // The open slit gives the compliance of the section.
  MatrixXd stiffness(12, 12);
  const Eigen::VectorXd omega = 2 * std::numbers::pi * shut.frequencies_Hz;
  stiffness << omega.cwiseAbs2().asDiagonal().toDenseMatrix(), found.coupling.transpose(),
      found.coupling, found.stiffness;
  MatrixXd top = MatrixXd::Zero(6, 12);
  top.topLeftCorner(3, 10) = shut.interface("top").translation;
  top.bottomLeftCorner(3, 10) = shut.interface("top").rotation;
  const Matrix6d open = top * stiffness.inverse() * top.transpose();
  const Matrix6d expected = open_compliance(top_stiffness(block(motions)));
  CHECK((open - expected).norm() < 1e-8 * expected.norm());
}

TEST_CASE("slits that open and close are refused where they cannot be") {
  using Catch::Matchers::Contains;
  const auto refused = [](const mesher::Mesh& mesh, const ModalOptions& options,
                          const std::string& why) {
    CHECK_THROWS_WITH(analyse_modes(mesh, options, {}), Contains(why));
  };
  ModalOptions options = options_with(SlitMotions::openings);
  refused(slit_block(true), options, "no open slit");
  options.mode_count = 2;
  refused(slit_block(false), options, "without modes");
  options.basis = BasisKind::residual;
  options.check = true;
  refused(slit_block(false), options, "modes.check");
  options = options_with(SlitMotions::openings);
  options.interfaces.front().is_rigid = true;
  refused(slit_block(false), options, "not supported with rigid interfaces");
}

}  // namespace flexneck::fe_modal
