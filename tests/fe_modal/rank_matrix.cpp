// SPDX-License-Identifier: GPL-3.0-or-later
// Constraints × solvers × ranks: this program runs under mpirun on one, two and three ranks, prints
// a cell for each kind of constraint and solver, and fails unless all agree with dense matrices in
// a basis of all motions that satisfy the constraints. It also counts modes below some frequencies,
// and compares the discretisation error estimate with that of a serial run.
#include <array>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "fe_modal/algebra/rank_session.h"
#include "fe_modal/analysis/modal_analysis.h"
#include "fe_modal/solve/assembled_system.h"
#include "fe_modal/solve/inertia.h"
#include "fe_modal/system/assembly.h"
#include "tests/fe_modal/dense.h"
#include "tests/fe_modal/dense_constraints.h"
#include "tests/fe_modal/interface_compliance.h"
#include "tests/support/block_mesh.h"

namespace flexneck::fe_modal {
namespace {

constexpr double kSame = 1e-9;
constexpr int kModes = 6;
const Eigen::Vector3d kTip(0.01, -0.02, 0.32);
const RigidAttachment kHead{
    "head", "tip", 4.5, {0.03, 0.01, 0.4}, 0.02 * Eigen::Matrix3d::Identity()};

/// A block of metal between rubber, without any symmetry.
mesher::Mesh block() {
  testing::BlockMesh box = testing::box({2, 1, 1}, {1, 1, 1}, {"soft", 8.3e6, 0.49, 950});
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
  bool has_direction = false;                ///< y of the top is fixed
  bool has_coupling = false;                 ///< the top is rigid
  void (*connect)(mesher::Mesh&) = nullptr;  ///< adds connections
};

struct Truth {
  Eigen::VectorXd frequencies_Hz;
  Eigen::VectorXd loaded_Hz;
  Eigen::MatrixXd compliance;  ///< compliance of the top's average motion
};

Eigen::VectorXd lowest_Hz(const Eigen::MatrixXd& stiffness, const Eigen::MatrixXd& mass) {
  return testing::lowest_values(stiffness, mass, kModes).cwiseSqrt() / (2 * std::numbers::pi);
}

/// Mass matrix of the head about the tip, from the velocity of its centre and its inertia about the
/// centre.
Matrix6d head_mass() {
  Eigen::Matrix<double, 3, 6> center = Eigen::Matrix<double, 3, 6>::Zero();
  for (Eigen::Index k = 0; k < 3; ++k) {
    center.col(k) = Eigen::Vector3d::Unit(k);
    center.col(3 + k) = Eigen::Vector3d::Unit(k).cross(kHead.center_m - kTip);
  }
  Matrix6d mass = kHead.mass_kg * center.transpose() * center;
  mass.bottomRightCorner<3, 3>() += kHead.inertia_kg_m2;
  return mass;
}

Truth truth_of(mesher::Mesh mesh, const Cell& cell) {
  const std::vector<std::int32_t> top = mesh.node_set("top").nodes;
  mesher::Connections& connections = mesh.connections;
  connections.supports.push_back({"bottom", mesh.node_set("bottom").nodes});
  if (cell.has_direction) connections.supports.push_back({"y", top, {false, true, false}});
  if (cell.has_coupling) {
    connections.couplings.push_back(
        {"top", static_cast<std::int32_t>(connections.points.size()), top});
    connections.points.push_back({"top", {kTip[0], kTip[1], kTip[2]}});
  }
  const DenseConstraints model = dense_model(mesh);
  const Eigen::MatrixXd motions = allowed_motions(model);
  const Eigen::MatrixXd stiffness = motions.transpose() * model.stiffness * motions;
  const Eigen::MatrixXd mass = motions.transpose() * model.mass * motions;
  mesh.connections = {};
  const DofMap all(mesh, {});
  const Eigen::MatrixXd average =
      average_motion(mesh, "top", kTip, all) * motions.topRows(all.dof_count());
  const Eigen::MatrixXd with_head = mass + average.transpose() * head_mass() * average;
  return {lowest_Hz(stiffness, mass), lowest_Hz(stiffness, with_head),
          average * testing::symmetric_solution(stiffness, average.transpose())};
}

mesher::AxisSystem axes(const Eigen::Vector3d& z, bool is_cylindrical) {
  return {{-0.4, 0.1, 0.05}, mesher::axes_from(z, Eigen::Vector3d::Zero()), is_cylindrical};
}

void add_oblique(mesher::Mesh& mesh) {
  mesh.connections.supports = {
      {"s", mesh.node_set("top").nodes, {false, false, true}, axes({-1, 0.5, 0.2}, false)}};
}

void add_cylindrical(mesher::Mesh& mesh) {
  mesh.connections.supports = {
      {"s", mesh.node_set("top").nodes, {true, false, true}, axes({0.2, -0.1, 1}, true)}};
}

void add_coupling_with_mass(mesher::Mesh& mesh) {
  mesh.connections.points = {{"tip", {0.02, 0.03, 0.36}}};
  mesh.connections.couplings = {{"c", 0, mesh.node_set("top").nodes}};
  const std::int32_t tip = mesher::translation_site(mesh.nodes.size(), 0);
  mesh.connections.masses = {
      {"m", tip, 2.5, {0.05, -0.02, 0.1}, {0.02, 0.03, 0.025, 0.003, -0.002, 0.004}}};
  const std::int32_t node = mesh.node_set("bottom").nodes.back() + 5;
  mesh.connections.equations = {
      {"e", {{node, {2, 0, 0}}, {tip, {-0.5, 0.1, 0}}, {tip + 1, {0, 0, 0.07}}}}};
}

void add_springs(mesher::Mesh& mesh) {
  const std::int32_t top = mesh.node_set("top").nodes.front();
  const std::int32_t node = mesh.node_set("bottom").nodes.back() + 5;
  mesh.connections.springs = {{"to ground", {{top, {0.6, 0, 0.8}}}, 3000},
                              {"between", {{top, {0, 1, 0}}, {node, {0, -1, 0}}}, 5000}};
  mesh.connections.masses = {{"m", top, 0.7, {}, {}}};
}

double difference(const Eigen::VectorXd& found, const Eigen::VectorXd& expected) {
  return (found.array() / expected.array() - 1).abs().maxCoeff();
}

/// Largest difference of the finer mesh's frequencies from those of a serial run.
double difference_of_refined(const ModalBody& found, const ModalBody& alone) {
  double largest = 0;
  for (std::size_t k = 0; k < kModes; ++k) {
    const double expected = alone.modes[k].mesh_error.value().refined_Hz;
    largest =
        std::max(largest, std::abs(found.modes[k].mesh_error.value().refined_Hz / expected - 1));
  }
  return largest;
}

/// Largest deviation of a cell, on the first rank; more than one if a result is missing.
double deviation(const mesher::Mesh& mesh, const Cell& cell, const Truth& truth, Solver solver,
                 const Ranks& ranks) {
  ModalOptions options;
  options.mode_count = kModes;
  options.solver = solver;
  options.ranks = ranks;
  options.basis = BasisKind::residual;
  options.check = true;
  options.fixed_set = "bottom";
  if (cell.has_direction) options.fixed_directions = {{"top", {false, true, false}}};
  options.interfaces = {{"tip", "top", kTip, cell.has_coupling}};
  options.attachments = {kHead};
  const ModalBody body = analyse_modes(mesh, options, {});
  if (!body.completeness.starts_with("checked")) return 2;
  if (body.mode_count() <= kModes) return 3;
  if (!ranks.is_first()) return 0;
  options.ranks = Ranks();
  const double refined = difference_of_refined(body, analyse_modes(mesh, options, {}));
  const Eigen::MatrixXd& compliance = body.interfaces.back().response.value().compliance;
  const double scale = truth.compliance.diagonal().maxCoeff();
  // The compliance of a fixed motion is zero, and cannot be divided by.
  return std::max({refined, difference(body.frequencies_Hz.head(kModes), truth.frequencies_Hz),
                   difference(body.attached.front().frequencies_Hz, truth.loaded_Hz),
                   (compliance - truth.compliance).cwiseAbs().maxCoeff() / scale});
}

int run_all(const Ranks& ranks) {
  const std::array<Cell, 7> cells = {
      {{"supports"},
       {"supports, single direction", true, false},
       {"supports, rigid coupling", false, true},
       {"supports, oblique", false, false, add_oblique},
       {"supports, cylindrical", false, false, add_cylindrical},
       {"supports, coupling with a mass, equation", false, false, add_coupling_with_mass},
       {"supports, springs and a mass", false, false, add_springs}}};
  int failures = 0;
  for (const Cell& cell : cells) {
    mesher::Mesh mesh = block();
    if (cell.connect != nullptr) cell.connect(mesh);
    const Truth truth = ranks.is_first() ? truth_of(mesh, cell) : Truth();
    for (const Solver solver : {Solver::cholmod, Solver::mumps}) {
      if (solver == Solver::cholmod && ranks.are_many()) continue;
      const double found = deviation(mesh, cell, truth, solver, ranks);
      if (!(found < kSame)) ++failures;
      if (ranks.is_first())
        std::printf("%d ranks, %s, %s: %.1e\n", ranks.count(), cell.name.c_str(),
                    solver_names().at(static_cast<std::size_t>(solver)).c_str(), found);
    }
  }
  return failures;
}

/// Total number of modes below some frequencies, counted by the ranks.
int count_all(const Ranks& ranks) {
  const mesher::Mesh mesh = block();
  const DofMap dof_map(mesh, mesh.node_set("bottom").nodes);
  const SystemMatrices whole = assemble(mesh, dof_map);
  const Eigen::VectorXd values =
      testing::dense_pairs(dense(whole.stiffness.get()), dense(whole.mass.get())).values;
  ModalOptions options;
  options.fixed_set = "bottom";
  options.ranks = ranks;
  const Model model(mesh, options);
  const AssembledSystem system(model);
  int failures = 0;
  for (const Eigen::Index below : {Eigen::Index(0), Eigen::Index(1), Eigen::Index(7),
                                   values.size() / 4, values.size() / 2, values.size()}) {
    const double upper = below < values.size() ? values[below] : 2 * values[below - 1];
    const double sigma = (upper + (below > 0 ? values[below - 1] : 0)) / 2;
    const Eigen::Index counted = negative_eigenvalues(
        shifted_stiffness(system.stiffness(), system.mass(), sigma).get(), ranks);
    if (counted != below) ++failures;
    if (ranks.is_first())
      std::printf("%d ranks, %td modes: %td counted\n", ranks.count(), below, counted);
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
    if (count_all(session.ranks()) > 0) outcome = {1, "modes are not counted as they are"};
  } catch (...) {
    outcome = {1, current_failure()};
  }
  return session.end(outcome,
                     [](const std::string& line) { std::fprintf(stderr, "%s\n", line.c_str()); });
}
