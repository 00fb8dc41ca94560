// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <numbers>
#include <vector>

#include <catch2/catch.hpp>

#include "fe_modal/analysis/modal_analysis.h"
#include "mesher/mesh/refinement.h"
#include "tests/support/block_mesh.h"
#include "tests/support/element_choices.h"
#include "tests/support/element_meshes.h"

namespace flexneck::fe_modal {
namespace {

ModalOptions fixed_at_bottom(int mode_count, bool check) {
  ModalOptions options;
  options.fixed_set = "bottom";
  options.mode_count = mode_count;
  options.check = check;
  return options;
}

/// Reference frequencies with 4 x 4 x 4 elements in place of each.
Eigen::VectorXd reference_Hz(const mesher::Mesh& mesh, int count) {
  return analyse_modes(mesher::refine(mesher::refine(mesh).mesh).mesh,
                       fixed_at_bottom(count, false), {})
      .frequencies_Hz;
}

/// Ratio of estimated to true error of each mode.
std::vector<double> effectivity(const mesher::Mesh& mesh, const Eigen::VectorXd& truth_Hz) {
  const ModalBody body =
      analyse_modes(mesh, fixed_at_bottom(static_cast<int>(truth_Hz.size()), true), {});
  std::vector<double> ratios;
  for (Eigen::Index k = 0; k < truth_Hz.size(); ++k) {
    const MeshError& estimate = body.modes[static_cast<std::size_t>(k)].mesh_error.value();
    CHECK(estimate.mac > 0.99);
    ratios.push_back(estimate.error / std::abs(body.frequencies_Hz[k] / truth_Hz[k] - 1));
  }
  return ratios;
}

void check_between_one_and_five(const std::vector<double>& ratios) {
  for (const double ratio : ratios) {
    CHECK(ratio > 1);
    CHECK(ratio < 5);
  }
}

}  // namespace

TEST_CASE("the mesh's error is estimated one to five times: stretch of a bar, closed form") {
  // With nu = 0 the bar is a rod fixed at one end, f = (2n - 1)/4L sqrt(E / rho), n = 1, 2; a
  // slender bar would have bending modes first, so it is short and thick: stretch is identified by
  // its frequency.
  constexpr double kLength = 0.1;
  const mesher::Mesh mesh =
      testing::box({1, 1, 2}, {0.2, 0.2, kLength}, {"steel", 2.1e11, 0, 7850}).make();
  const double closed_form = std::sqrt(2.1e11 / 7850) / (4 * kLength);
  const ModalBody body = analyse_modes(mesh, fixed_at_bottom(6, true), {});
  int found = 0;
  for (Eigen::Index k = 0; k < body.mode_count(); ++k) {
    const double truth = body.frequencies_Hz[k] / closed_form - 1;
    if (std::abs(truth) > 2e-3) continue;
    ++found;
    const double ratio = body.modes[static_cast<std::size_t>(k)].mesh_error->error / truth;
    CHECK(ratio > 1);
    CHECK(ratio < 5);
  }
  CHECK(found == 1);
}

TEST_CASE("the mesh's error is estimated one to five times: a plate rocking on bonded rubber") {
  // The reference is a mesh with 4 x 4 x 4 elements in place of one, with an error at least four
  // times smaller at the order that the singular edges leave.
  testing::BlockMesh pad = testing::box({2, 2, 1}, {0.08, 0.08, 0.03}, {});
  pad.slices = {{"pad", 2, {"rubber", 8.3e6, 0.49, 950}}, {"plate", 1, kSteel}};
  const mesher::Mesh mesh = pad.make();
  check_between_one_and_five(effectivity(mesh, reference_Hz(mesh, 3)));
}

TEST_CASE("the mesh's error is estimated one to five times: bending and twist of a steel tube") {
  const mesher::Mesh mesh = testing::tube({1, 6, 2}, 0.04, 0.06, 0.2, kSteel).make();
  const Eigen::VectorXd reference = reference_Hz(mesh, 3);
  // Torsion has no singularity except at the fixed end, and a closed form.
  const double wave_m_s = std::sqrt(kSteel.youngs_modulus_Pa / 2.6 / kSteel.density_kg_m3);
  CHECK(reference[2] == Approx(wave_m_s / 0.8).epsilon(1e-4));
  check_between_one_and_five(effectivity(mesh, reference));
}

TEST_CASE("the mesh's error is estimated within its band: linear elements that lock in bending") {
  // Elements ten times as long as thick are six times too stiff, and torsion comes before bending
  // modes that should come before it. Expected values are closed forms of Euler and Bernoulli, and
  // of the torsion of a square section.
  constexpr double kSide = 0.01;
  constexpr double kLength = 0.8;
  const mesher::Mesh mesh = testing::with_kind(
      testing::box({1, 1, 8}, {kSide, kSide, kLength}, kSteel).make(), mesher::ElementKind::hex8);
  const double wave_m_s = std::sqrt(kSteel.youngs_modulus_Pa / kSteel.density_kg_m3);
  const double bending_Hz =
      wave_m_s * kSide / std::sqrt(12.0) / (2 * std::numbers::pi) / (kLength * kLength);
  const double twist_Hz = wave_m_s / std::sqrt(2.6) * std::sqrt(6 * 0.1406) / (4 * kLength);
  const std::vector<double> truth = {3.5160 * bending_Hz,
                                     3.5160 * bending_Hz,
                                     22.0345 * bending_Hz,
                                     22.0345 * bending_Hz,
                                     twist_Hz,
                                     61.6972 * bending_Hz};
  const ModalBody body = analyse_modes(mesh, fixed_at_bottom(6, true), {});
  for (std::size_t k = 0; k < truth.size(); ++k) {
    const double error = body.frequencies_Hz[static_cast<Eigen::Index>(k)] / truth[k] - 1;
    CHECK(error > (k == 4 ? 0.05 : 4));
    CHECK(body.modes[k].mesh_error->error > 0.7 * error);
    CHECK(body.modes[k].mesh_error->error < 5 * error);
  }
}

TEST_CASE("the mesh's error is estimated within its band: elements 200 times as long as thick") {
  constexpr double kSide = 0.01;
  constexpr double kLength = 16;
  const mesher::Mesh mesh = testing::with_kind(
      testing::box({1, 1, 8}, {kSide, kSide, kLength}, kSteel).make(), mesher::ElementKind::hex20);
  const double bending_Hz = std::sqrt(kSteel.youngs_modulus_Pa / kSteel.density_kg_m3) * kSide /
                            std::sqrt(12.0) / (2 * std::numbers::pi) / (kLength * kLength);
  const ModalBody body = analyse_modes(mesh, fixed_at_bottom(6, true), {});
  // The errors of the first two are too near to rounding to be compared.
  for (std::size_t k = 2; k < 6; ++k) {
    const double truth_Hz = (k < 4 ? 22.0345 : 61.6972) * bending_Hz;
    const double error = body.frequencies_Hz[static_cast<Eigen::Index>(k)] / truth_Hz - 1;
    CHECK(body.modes[k].mesh_error->error > 0.7 * error);
    CHECK(body.modes[k].mesh_error->error < 5 * error);
  }
}

TEST_CASE("rigid-body motions of a free body have no error, its elastic modes have one") {
  ModalOptions options;
  options.mode_count = 8;
  options.check = true;
  const ModalBody body =
      analyse_modes(testing::box({1, 1, 4}, {0.1, 0.1, 0.4}, kSteel).make(), options, {});
  for (std::size_t k = 0; k < 6; ++k) CHECK(body.modes[k].mesh_error->error == 0);
  for (std::size_t k = 6; k < 8; ++k) {
    CHECK(body.modes[k].mesh_error->error > 1e-4);
    CHECK(body.modes[k].mesh_error->error < 0.2);
    CHECK(body.modes[k].mesh_error->mac > 0.99);
  }
}

TEST_CASE("without --check nothing is estimated") {
  const ModalBody body = analyse_modes(testing::box({1, 1, 2}, {0.1, 0.1, 0.3}, kSteel).make(),
                                       fixed_at_bottom(2, false), {});
  CHECK_FALSE(body.modes.front().mesh_error.has_value());
}

}  // namespace flexneck::fe_modal
