// SPDX-License-Identifier: GPL-3.0-or-later
// Constraints × solvers × ranks: this program runs under mpirun on one, two and three ranks, prints
// a cell for each kind of constraint and solver, and fails unless all agree with dense matrices
// whose constraints are made by a basis of all motions that they allow.
#include <array>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "fe_modal/algebra/rank_session.h"
#include "fe_modal/analysis/modal_analysis.h"
#include "fe_modal/system/assembly.h"
#include "tests/fe_modal/dense.h"
#include "tests/fe_modal/interface_compliance.h"
#include "tests/support/block_mesh.h"
#include "tests/support/dense_solvers.h"

namespace flexneck::fe_modal {
namespace {

constexpr double kSame = 1e-9;
constexpr int kModes = 6;
const Eigen::Vector3d kTip(0.01, -0.02, 0.32);

/// Metal between rubber, without any symmetry.
mesher::Mesh block() {
  testing::BlockMesh box = testing::box({2, 2, 1}, {1, 1, 1}, {"soft", 8.3e6, 0.49, 950});
  box.slices = {{"lower", 2, {"soft", 8.3e6, 0.49, 950}},
                {"plate", 1, {"metal", 7e10, 0.3, 2700}},
                {"upper", 1, {"softer", 5e6, 0.49, 950}}};
  box.position = [](const Eigen::Vector3d& p) -> Eigen::Vector3d {
    return 0.3 * testing::distorted(p).cwiseProduct(Eigen::Vector3d(0.4, 0.5, 1));
  };
  return box.make();
}

struct Cell {
  std::string name;
  bool has_direction = false;  ///< y of the top is fixed
  bool has_coupling = false;   ///< the top is rigid
};

/// All motions that the constraints allow, by all degrees of freedom of the mesh, (3 n, m).
Eigen::MatrixXd allowed_motions(const mesher::Mesh& mesh, const Cell& cell) {
  const auto size = static_cast<Eigen::Index>(3 * mesh.nodes.size());
  std::vector<Eigen::VectorXd> columns;
  std::vector<bool> is_done(static_cast<std::size_t>(size), false);
  for (const std::int32_t node : mesh.node_set("bottom").nodes) {
    for (std::int32_t a = 0; a < 3; ++a) is_done[static_cast<std::size_t>(3 * node + a)] = true;
  }
  for (const std::int32_t node : mesh.node_set("top").nodes) {
    if (cell.has_direction) is_done[static_cast<std::size_t>(3 * node + 1)] = true;
    for (std::int32_t a = 0; cell.has_coupling && a < 3; ++a) {
      is_done[static_cast<std::size_t>(3 * node + a)] = true;
    }
  }
  for (Eigen::Index k = 0; k < size; ++k) {
    if (!is_done[static_cast<std::size_t>(k)]) columns.push_back(Eigen::VectorXd::Unit(size, k));
  }
  for (Eigen::Index a = 0; cell.has_coupling && a < 3; ++a) {
    const Eigen::Vector3d axis = Eigen::Vector3d::Unit(a);
    Eigen::VectorXd shift = Eigen::VectorXd::Zero(size);
    Eigen::VectorXd turn = Eigen::VectorXd::Zero(size);
    for (const std::int32_t node : mesh.node_set("top").nodes) {
      const Eigen::Vector3d x =
          Eigen::Map<const Eigen::Vector3d>(mesh.nodes[static_cast<std::size_t>(node)].data());
      shift.segment<3>(3 * static_cast<Eigen::Index>(node)) = axis;
      turn.segment<3>(3 * static_cast<Eigen::Index>(node)) = axis.cross(x);
    }
    columns.push_back(shift);
    columns.push_back(turn);
  }
  Eigen::MatrixXd motions(size, static_cast<Eigen::Index>(columns.size()));
  for (std::size_t k = 0; k < columns.size(); ++k)
    motions.col(static_cast<Eigen::Index>(k)) = columns[k];
  return motions;
}

struct Truth {
  Eigen::VectorXd frequencies_Hz;
  Eigen::VectorXd loaded_Hz;
  Eigen::MatrixXd compliance;  ///< of the top's average motion
};

Eigen::VectorXd hertz(const Eigen::VectorXd& values) {
  return values.head(kModes).cwiseSqrt() / (2 * std::numbers::pi);
}

Truth truth_of(const mesher::Mesh& mesh, const Cell& cell, const Matrix6d& head) {
  const DofMap all(mesh, {});
  const SystemMatrices system = assemble(mesh, all);
  const Eigen::MatrixXd motions = allowed_motions(mesh, cell);
  const Eigen::MatrixXd stiffness = motions.transpose() * dense(system.stiffness.get()) * motions;
  const Eigen::MatrixXd mass = motions.transpose() * dense(system.mass.get()) * motions;
  const Eigen::MatrixXd average = average_motion(mesh, "top", kTip, all) * motions;
  return {
      hertz(testing::dense_pairs(stiffness, mass).values),
      hertz(testing::dense_pairs(stiffness, mass + average.transpose() * head * average).values),
      average * testing::symmetric_solution(stiffness, average.transpose())};
}

double difference(const Eigen::VectorXd& found, const Eigen::VectorXd& expected) {
  return (found.array() / expected.array() - 1).abs().maxCoeff();
}

/// Largest deviation of a cell; more than one where something is missing.
double deviation(const mesher::Mesh& mesh, const Cell& cell, Solver solver, const Ranks& ranks) {
  ModalOptions options;
  options.mode_count = kModes;
  options.solver = solver;
  options.ranks = ranks;
  options.basis = BasisKind::residual;
  options.certify = true;
  options.fixed_set = "bottom";
  if (cell.has_direction) options.fixed_directions = {{"top", {false, true, false}}};
  options.interfaces = {{"tip", "top", kTip, cell.has_coupling}};
  options.attachments = {
      {"head", "tip", 4.5, {0.03, 0.01, 0.4}, 0.02 * Eigen::Matrix3d::Identity()}};
  const ModalBody body = analyse_modes(mesh, options, {});
  const Truth truth = truth_of(mesh, cell, body.attached.front().mass_matrix.value());
  if (!body.certificate.starts_with("certified")) return 2;
  if (body.mode_count() <= kModes) return 3;
  const Eigen::MatrixXd& compliance = body.interfaces.back().response.value().compliance;
  const double scale = truth.compliance.diagonal().maxCoeff();
  // Of a motion that is fixed there is no compliance to divide by.
  return std::max({difference(body.frequencies_Hz.head(kModes), truth.frequencies_Hz),
                   difference(body.attached.front().frequencies_Hz, truth.loaded_Hz),
                   0.1 * (compliance - truth.compliance).cwiseAbs().maxCoeff() / scale});
}

int run_all(const Ranks& ranks) {
  const std::array<Cell, 3> cells = {{{"supports"},
                                      {"supports, single direction", true, false},
                                      {"supports, rigid coupling", false, true}}};
  const mesher::Mesh mesh = block();
  int failures = 0;
  for (const Cell& cell : cells) {
    for (const Solver solver : {Solver::direct, Solver::iterative}) {
      const double found = deviation(mesh, cell, solver, ranks);
      if (!(found < kSame)) ++failures;
      if (ranks.is_first())
        std::printf("%d ranks, %s, %s: %.1e\n", ranks.count(), cell.name.c_str(),
                    solver == Solver::direct ? "direct" : "iterative", found);
    }
  }
  return failures;
}

}  // namespace
}  // namespace flexneck::fe_modal

int main() {
  using namespace flexneck::fe_modal;
  const RankSession session;
  RankOutcome outcome;
  try {
    if (run_all(session.ranks()) > 0) outcome = {1, "a cell deviates by more than 1e-9"};
  } catch (...) {
    outcome = {1, current_failure()};
  }
  return session.end(outcome,
                     [](const std::string& line) { std::fprintf(stderr, "%s\n", line.c_str()); });
}
