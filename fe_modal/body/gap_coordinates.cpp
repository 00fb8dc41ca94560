// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/body/gap_coordinates.h"

#include <array>
#include <numbers>
#include <string>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>

#include "fe_modal/body/basis_kind.h"
#include "geometry/foundation/error.h"

namespace flexneck::fe_modal {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Motions of the modes in slits, openings first, and at interfaces off the fixed nodes.
struct Motions {
  MatrixXd slits, interfaces;
  Index openings = 0;
};

Motions motions_of(const ModalBody& body) {
  const Index m = body.mode_count();
  Motions motions;
  motions.slits.resize(static_cast<Index>(body.slits.size()), m);
  Index row = 0;
  for (const bool opens : {true, false}) {
    for (const SlitMotion& slit : body.slits)
      if (slit.opens == opens) motions.slits.row(row++) = slit.amplitude;
    if (opens) motions.openings = row;
  }
  motions.interfaces.resize(6 * static_cast<Index>(body.interfaces.size()), m);
  row = 0;
  for (const Interface& each : body.interfaces) {
    if (each.translation.isZero(0) && each.rotation.isZero(0)) continue;
    motions.interfaces.middleRows<3>(row) = each.translation;
    motions.interfaces.middleRows<3>(row + 3) = each.rotation;
    row += 6;
  }
  motions.interfaces.conservativeResize(row, m);
  return motions;
}

/// Combinations of modes of least energy, each of which makes one motion of a slit and moves no
/// interface, (m, motions of slits).
MatrixXd parting(const Motions& motions, const VectorXd& stiffness) {
  constexpr double kLeastReciprocalCondition = 1e-10;
  MatrixXd held(motions.slits.rows() + motions.interfaces.rows(), stiffness.size());
  held << motions.slits, motions.interfaces;
  // The energy is the squared norm in coordinates sqrt(stiffness) a.
  const VectorXd scale = stiffness.cwiseSqrt().cwiseInverse();
  held = held * scale.asDiagonal();
  const VectorXd sizes = held.rowwise().norm();
  held = sizes.cwiseInverse().asDiagonal() * held;
  const Eigen::FullPivLU<MatrixXd> pivots(held * held.transpose());
  if (held.rows() > held.cols() || !(sizes.array() > 0).all() ||
      pivots.rcond() < kLeastReciprocalCondition)
    throw InputError(
        "the modes do not move the interfaces and open the slits independently of one another; a "
        "body whose slits open and close needs the static shapes of all its interfaces");
  const Index ways = motions.slits.rows();
  const MatrixXd amplitudes = sizes.head(ways).cwiseInverse().asDiagonal();
  MatrixXd right = MatrixXd::Zero(held.rows(), ways);
  right.topRows(ways) = amplitudes;
  return scale.asDiagonal() * (held.transpose() * pivots.solve(right));
}

/// Combinations of modes that do not move the sides of any slit apart.
MatrixXd shut(const Motions& motions) {
  const Index m = motions.slits.cols();
  const Eigen::HouseholderQR<MatrixXd> qr(motions.slits.transpose());
  const MatrixXd all = qr.householderQ() * MatrixXd::Identity(m, m);
  return all.rightCols(m - motions.slits.rows());
}

/// Invariants in other coordinates b, a = T b.
InertiaInvariants transformed(const InertiaInvariants& from, const MatrixXd& T) {
  InertiaInvariants to = from;
  to.S2 = from.S2 * T;
  to.N0 = from.N0 * T;
  to.Maa = T.transpose() * from.Maa * T;
  const auto m = static_cast<std::size_t>(T.rows());
  const auto sum = [&](const auto& values, std::size_t first, Index column) {
    auto total = (0 * values[first]).eval();
    for (std::size_t k = 0; k < m; ++k)
      total += T(static_cast<Index>(k), column) * values[first + k];
    return total;
  };
  const auto pairs = [&](const auto& values) {
    auto by_second = values;
    by_second.clear();  // entry (j, l): j in the old, l in the new coordinates
    for (std::size_t j = 0; j < m; ++j)
      for (Index l = 0; l < T.cols(); ++l) by_second.push_back(sum(values, j * m, l));
    auto both = values;
    both.clear();
    const auto count = static_cast<std::size_t>(T.cols());
    for (Index j = 0; j < T.cols(); ++j)
      for (std::size_t l = 0; l < count; ++l) {
        auto total = (0 * by_second[l]).eval();
        for (std::size_t k = 0; k < m; ++k)
          total += T(static_cast<Index>(k), j) * by_second[k * count + l];
        both.push_back(total);
      }
    return both;
  };
  to.G0.clear();
  for (Index l = 0; l < T.cols(); ++l) to.G0.push_back(sum(from.G0, 0, l));
  to.G = pairs(from.G);
  to.N = pairs(from.N);
  return to;
}

/// Energy fractions of a combination: mean of the modes' fractions, weighted by kinetic energy. It
/// leaves out cross terms of modes of different kinds, which are zero if only modes of one kind are
/// combined, as in a body that is symmetric about a plane.
std::array<double, 4> mixed_shares(const std::vector<ModeRecord>& modes, const VectorXd& weights) {
  const VectorXd energies = weights.cwiseAbs2();
  std::array<double, 4> shares{};
  for (std::size_t l = 0; l < modes.size(); ++l)
    for (std::size_t kind = 0; kind < shares.size(); ++kind)
      shares[kind] += energies[static_cast<Index>(l)] * modes[l].shares_percent[kind];
  return shares;
}

/// The body in other coordinates, a = T b.
/// @param statics  number of the new modes, the last ones, that only complete the static compliance
ModalBody transformed(const ModalBody& body, const MatrixXd& T, const VectorXd& values,
                      Index statics) {
  ModalBody to;
  to.frequencies_Hz = values.cwiseSqrt() / (2 * std::numbers::pi);
  to.boundary = body.boundary;
  to.completeness = body.completeness;
  to.solver = body.solver;
  to.orthogonality = body.orthogonality;
  to.nodes_m = body.nodes_m;
  to.invariants = transformed(body.invariants, T);
  for (Index k = 0; k < T.cols(); ++k) {
    const bool is_mode = k < T.cols() - statics;
    to.modes.push_back({"shut " + std::to_string(k + 1),
                        std::string(is_mode ? kRitzMode : kConstraintMode),
                        mixed_shares(body.modes, T.col(k))});
    Eigen::Matrix3Xd shape = Eigen::Matrix3Xd::Zero(3, body.nodes_m.cols());
    for (Index l = 0; l < T.rows(); ++l)
      shape += T(l, k) * body.shapes[static_cast<std::size_t>(l)];
    to.shapes.push_back(std::move(shape));
  }
  for (const Interface& each : body.interfaces)
    to.interfaces.push_back(
        {each.name, each.position_m, each.translation * T, each.rotation * T, each.response});
  return to;
}

}  // namespace

GapBody with_gap_coordinates(const ModalBody& body) {
  if (body.geometric_stiffness || !body.prestress.empty())
    throw InputError(
        "slits that open and close are not supported with stress stiffening or prestress");
  const Motions motions = motions_of(body);
  const VectorXd stiffness = (2 * std::numbers::pi * body.frequencies_Hz).cwiseAbs2();
  const MatrixXd parted = parting(motions, stiffness);
  MatrixXd still = shut(motions);
  MatrixXd openings = parted.leftCols(motions.openings);
  const MatrixXd sliding = parted.rightCols(parted.cols() - motions.openings);
  if (sliding.cols() > 0) {
    const MatrixXd loads = sliding.transpose() * stiffness.asDiagonal();
    const Eigen::LDLT<MatrixXd> factor(loads * sliding);
    still -= sliding * factor.solve(loads * still);
    openings -= sliding * factor.solve(loads * openings);
  }
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> pairs(
      still.transpose() * stiffness.asDiagonal() * still, still.transpose() * still);
  if (pairs.info() != Eigen::Success)
    throw ComputationError("the eigensolution of the body with closed slits failed");
  const MatrixXd T = still * pairs.eigenvectors();
  const MatrixXd loads = openings.transpose() * stiffness.asDiagonal();
  return {transformed(body, T, pairs.eigenvalues(), motions.interfaces.rows()), loads * openings,
          loads * T};
}

}  // namespace flexneck::fe_modal
