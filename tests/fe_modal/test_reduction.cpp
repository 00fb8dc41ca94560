// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/LU>
#include <catch2/catch.hpp>

#include "fe_modal/analysis/modal_analysis.h"
#include "fe_modal/body/mode_count_study.h"
#include "fe_modal/solve/attached_mass.h"
#include "fe_modal/system/assembly.h"
#include "geometry/foundation/error.h"
#include "tests/fe_modal/dense.h"
#include "tests/fe_modal/interface_compliance.h"
#include "tests/support/block_mesh.h"
#include "tests/support/dense_solvers.h"

namespace flexneck::fe_modal {
namespace {

/// Required relative accuracy of the captured compliance.
constexpr double kCompliance = 1e-8;
/// Relative difference of two solutions of the same small problem in double precision.
constexpr double kSame = 1e-9;
const Eigen::Vector3d kTip(0.01, -0.02, 0.32);
const Eigen::Vector3d kRoot(0.02, 0.01, 0);

/// A rubber block without any symmetry.
const mesher::Mesh& block() {
  static const mesher::Mesh mesh = [] {
    testing::BlockMesh box = testing::box({1, 1, 2}, {1, 1, 1}, {"rubber", 8.3e6, 0.49, 950});
    box.position = [](const Eigen::Vector3d& p) -> Eigen::Vector3d {
      return 0.3 * testing::distorted(p).cwiseProduct(Eigen::Vector3d(0.4, 0.5, 1));
    };
    return box.make();
  }();
  return mesh;
}

ModalOptions fixed(BasisKind basis, int count) {
  ModalOptions options;
  options.mode_count = count;
  options.basis = basis;
  options.fixed_set = "bottom";
  options.interfaces = {{"tip", "top", kTip}};
  return options;
}

ModalOptions free_block(BasisKind basis, int count) {
  ModalOptions options;
  options.mode_count = count;
  options.basis = basis;
  options.interfaces = {{"tip", "top", kTip}, {"root", "bottom", kRoot}};
  return options;
}

/// Matrices of the finite element model and an interface's average motion C.
struct Dense {
  Eigen::MatrixXd stiffness;
  Eigen::MatrixXd mass;
  Eigen::MatrixXd average;  ///< (6, dofs)
};

Dense dense_model(const std::vector<std::int32_t>& fixed_nodes, const std::string& set,
                  const Eigen::Vector3d& point) {
  const DofMap dof_map(block(), fixed_nodes);
  const SystemMatrices system = assemble(block(), dof_map);
  Dense model{dense(system.stiffness.get()), dense(system.mass.get()),
              Eigen::MatrixXd(6, dof_map.dof_count())};
  const auto weights =
      RigidAverage(block(), block().face_set(set), point).weights(dof_map.node_count());
  for (std::size_t i = 0; i < 6; ++i) {
    model.average.row(static_cast<Eigen::Index>(i)) = dof_map.gather(weights[i]).transpose();
  }
  return model;
}

Dense fixed_model() { return dense_model(block().node_set("bottom").nodes, "top", kTip); }

/// Compliance of a body's modes at an interface.
Matrix6d captured(const ModalBody& body, const std::string& interface) {
  const Interface& where = body.interface(interface);
  Eigen::MatrixXd motions(6, body.mode_count());
  motions << where.translation, where.rotation;
  Matrix6d sum = Matrix6d::Zero();
  for (Eigen::Index k = 0; k < body.mode_count(); ++k) {
    const double omega = 2 * std::numbers::pi * body.frequencies_Hz[k];
    if (omega > 0) sum += motions.col(k) * motions.col(k).transpose() / (omega * omega);
  }
  return sum;
}

long count_of(const ModalBody& body, std::string_view kind) {
  return std::count_if(body.modes.begin(), body.modes.end(),
                       [&](const ModeRecord& mode) { return mode.kind == kind; });
}

void check_basis(const ModalBody& body) {
  CHECK(body.orthogonality < kSame);
  CHECK(std::is_sorted(body.frequencies_Hz.begin(), body.frequencies_Hz.end()));
}

}  // namespace

TEST_CASE("modes with residual modes have the compliance of direct static solutions") {
  const ModalBody body = analyse_modes(block(), fixed(BasisKind::residual, 3), {});
  const Dense model = fixed_model();
  const Eigen::MatrixXd shapes =
      testing::symmetric_solution(model.stiffness, model.average.transpose());
  const Eigen::MatrixXd exact = model.average * shapes;
  CHECK(difference(captured(body, "tip"), exact) < kCompliance);
  CHECK(count_of(body, kNormalMode) == 3);
  CHECK(count_of(body, kResidualMode) == 6);
  CHECK(body.modes[3].name == "residual 1");
  check_basis(body);
  // Without residual modes much of the compliance is missing, and the response shows how much.
  const ModalBody plain = analyse_modes(block(), fixed(BasisKind::normal, 3), {});
  REQUIRE(plain.mode_count() == 3);
  CHECK(difference(captured(plain, "tip"), exact) > 0.1);
  const StaticResponse& response = *plain.interface("tip").response;
  CHECK(difference(response.compliance, exact) < kCompliance);
  CHECK(difference(response.mass, shapes.transpose() * model.mass * shapes) < kCompliance);
  // A mode is an eigenvector, a correction is not.
  CHECK(body.modes[2].residual < 1e-6);
  CHECK(body.modes[3].residual > 1e-3);
}

TEST_CASE("a Craig-Bampton basis is that of the textbook's dense matrices") {
  constexpr int kCount = 4;
  const ModalBody body = analyse_modes(block(), fixed(BasisKind::craig_bampton, kCount), {});
  const Dense model = fixed_model();
  const Eigen::MatrixXd shapes =
      testing::symmetric_solution(model.stiffness, model.average.transpose());
  CHECK(difference(captured(body, "tip"), model.average * shapes) < kCompliance);
  CHECK(count_of(body, kRitzMode) == kCount);
  CHECK(count_of(body, kConstraintMode) == 6);
  check_basis(body);

  // The expected basis is the modes on the null space of C, with the constraint modes.
  const Eigen::MatrixXd inside = testing::null_space(model.average);
  const testing::DensePairs fixed = testing::dense_pairs(
      inside.transpose() * model.stiffness * inside, inside.transpose() * model.mass * inside);
  Eigen::MatrixXd basis(shapes.rows(), kCount + 6);
  basis << inside * fixed.vectors.leftCols(kCount), shapes * (model.average * shapes).inverse();
  const Eigen::VectorXd expected = testing::dense_pairs(basis.transpose() * model.stiffness * basis,
                                                        basis.transpose() * model.mass * basis)
                                       .values.cwiseSqrt() /
                                   (2 * std::numbers::pi);
  CHECK((body.frequencies_Hz.array() / expected.array() - 1).abs().maxCoeff() < 1e-8);
}

TEST_CASE("a free body with inertia relief deforms as all its elastic modes would have it") {
  const ModalBody body = analyse_modes(block(), free_block(BasisKind::inertia_relief, 9), {});
  CHECK(count_of(body, kRigidMode) == 6);
  CHECK(count_of(body, kNormalMode) == 3);
  CHECK(count_of(body, kReliefMode) == 12);
  check_basis(body);
  for (const auto& [name, set, point] :
       {std::tuple{"tip", "top", kTip}, {"root", "bottom", kRoot}}) {
    CAPTURE(name);
    const Dense model = dense_model({}, set, point);
    const testing::DensePairs all = testing::dense_pairs(model.stiffness, model.mass);
    const Eigen::Index elastic = all.values.size() - 6;
    const Eigen::MatrixXd motions = model.average * all.vectors.rightCols(elastic);
    const Eigen::MatrixXd exact =
        motions * all.values.tail(elastic).cwiseInverse().asDiagonal() * motions.transpose();
    CHECK(difference(captured(body, name), exact) < kCompliance);
    CHECK(difference(body.interface(name).response->compliance, exact) < kCompliance);
  }
}

TEST_CASE("correction modes that others hold already are dropped and told of") {
  std::vector<std::string> lines;
  const auto record = [&](const std::string& line) { lines.push_back(line); };
  const auto told = [&](const std::string& text) {
    return std::any_of(lines.begin(), lines.end(), [&](const std::string& line) {
      return line.find(text) != std::string::npos;
    });
  };
  // The second interface is on the same face.
  ModalOptions options = fixed(BasisKind::residual, 3);
  options.interfaces.push_back({"twin", "top", {0, 0, 0}});
  ModalBody body = analyse_modes(block(), options, record);
  CHECK(count_of(body, kResidualMode) == 6);
  CHECK(told("6 of 12 correction modes are dropped"));
  check_basis(body);
  options.basis_interfaces = {"twin"};
  lines.clear();
  body = analyse_modes(block(), options, record);
  CHECK(count_of(body, kResidualMode) == 6);
  CHECK_FALSE(told("dropped"));
  // The basis has all modes of the model.
  options = fixed(BasisKind::residual, 108);
  body = analyse_modes(block(), options, record);
  CHECK(count_of(body, kResidualMode) == 0);
  CHECK(told("6 of 6 correction modes are dropped"));
}

TEST_CASE("the study of mode counts is what bodies with so many modes and residual modes give") {
  Eigen::Matrix3d inertia;
  inertia << 0.020, 0.002, -0.001, 0.002, 0.024, 0.003, -0.001, 0.003, 0.018;
  ModalOptions options = fixed(BasisKind::normal, 6);
  options.attachments = {{"head", "tip", 4.5, kTip + Eigen::Vector3d(0.02, 0, 0.05), inertia}};
  const ModalBody six = analyse_modes(block(), options, {});
  const AttachedFrequencies& exact = six.attached.at(0);
  const std::vector<ModeCountRow> rows = mode_count_study(six, exact);
  REQUIRE(rows.size() == 3);
  for (const ModeCountRow& row : rows) {
    CAPTURE(row.kept);
    options = fixed(BasisKind::residual, std::stoi(row.kept));
    const ModalBody few = analyse_modes(block(), options, {});
    // The motions are those of its own vectors, including residual ones.
    const Interface& tip = few.interface("tip");
    Eigen::MatrixXd motions(6, few.mode_count());
    motions << tip.translation, tip.rotation;
    const auto frequencies = [&](Eigen::Index m) -> Eigen::VectorXd {
      const Eigen::MatrixXd mass =
          Eigen::MatrixXd::Identity(m, m) +
          motions.leftCols(m).transpose() * *exact.mass_matrix * motions.leftCols(m);
      const Eigen::MatrixXd stiffness = few.frequencies_Hz.head(m).cwiseAbs2().asDiagonal();
      return testing::dense_pairs(stiffness, mass).values.cwiseSqrt();
    };
    const Eigen::VectorXd modes_only = frequencies(std::stoi(row.kept));
    const Eigen::VectorXd corrected = frequencies(few.mode_count());
    const Eigen::Index n = row.modes_only_Hz.size();
    CHECK((row.modes_only_Hz.array() / modes_only.array().head(n) - 1).abs().maxCoeff() < kSame);
    CHECK((row.corrected_Hz.array() / corrected.array().head(6) - 1).abs().maxCoeff() < kSame);
    // Ritz values are above the exact ones, and nearer with corrections.
    CHECK(row.corrected_Hz[0] > exact.frequencies_Hz[0] * (1 - kSame));
    CHECK(row.corrected_Hz[0] < row.modes_only_Hz[0]);
  }
}

TEST_CASE("a basis that the boundary or the interfaces do not allow is refused") {
  const auto complaint = [](const ModalOptions& options) -> std::string {
    try {
      analyse_modes(block(), options, {});
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  using Catch::Contains;
  CHECK_THAT(complaint(free_block(BasisKind::residual, 9)), Contains("use 'inertia-relief'"));
  CHECK_THAT(complaint(fixed(BasisKind::inertia_relief, 9)), Contains("'fixed: bottom' has none"));
  CHECK_THAT(complaint(free_block(BasisKind::inertia_relief, 5)),
             Contains("request 6 modes or more"));
  CHECK_THAT(complaint(fixed(BasisKind::craig_bampton, 103)), Contains("108 degrees of freedom"));
  ModalOptions options = fixed(BasisKind::residual, 3);
  options.basis_interfaces = {"tp"};
  CHECK_THAT(complaint(options), Contains("'tp'") && Contains("tip"));
  options = fixed(BasisKind::residual, 3);
  options.interfaces.clear();
  CHECK_THAT(complaint(options), Contains("define an interface"));
}

}  // namespace flexneck::fe_modal
