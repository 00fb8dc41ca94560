// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/exchange/reduced_body.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <Eigen/Cholesky>

#include "fe_modal/body/basis_kind.h"
#include "fe_modal/body/modal_body_check.h"
#include "fe_modal/body/skew.h"
#include "geometry/foundation/error.h"
#include "geometry/foundation/output_file.h"
#include "geometry/foundation/symmetric_pairs.h"

namespace flexneck::fe_modal {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr double kAgree = 1e-6;      ///< largest relative difference of redundant numbers of a file
constexpr double kRounding = 1e-12;  ///< largest relative rounding in a diagonal matrix
constexpr double kNothing = 1e-10;   ///< fraction of the largest eigenvalue that is no stiffness
constexpr std::array kKinds = {kNormalMode, kRigidMode, kResidualMode,
                               kReliefMode, kRitzMode,  kConstraintMode};

std::size_t place(Index k) { return static_cast<std::size_t>(k); }

/// Eigenvalues, and the eigenvectors in columns.
struct Spectrum {
  Eigen::VectorXd squares;
  MatrixXd vectors;
  bool is_as_given = false;
};

/// Returns whether the modes are already mass-orthonormal, uncoupled and in ascending order.
bool are_eigenvectors(const ReducedBody& reduced) {
  const MatrixXd& mass = reduced.invariants.Maa;
  const Eigen::VectorXd squares = reduced.stiffness.diagonal();
  const double largest = squares.cwiseAbs().maxCoeff();
  MatrixXd coupling = reduced.stiffness;
  coupling.diagonal().setZero();
  return (mass - MatrixXd::Identity(mass.rows(), mass.cols())).cwiseAbs().maxCoeff() <= kRounding &&
         coupling.cwiseAbs().maxCoeff() <= kRounding * largest &&
         std::is_sorted(squares.begin(), squares.end());
}

Spectrum spectrum_of(const ReducedBody& reduced) {
  const Index m = reduced.stiffness.rows();
  if (are_eigenvectors(reduced))
    return {reduced.stiffness.diagonal(), MatrixXd::Identity(m, m), true};
  if (Eigen::LLT<MatrixXd>(reduced.invariants.Maa).info() != Eigen::Success)
    throw InputError("expected a positive definite generalised mass matrix");
  auto [values, vectors] = symmetric_pairs(reduced.stiffness, reduced.invariants.Maa);
  return {std::move(values), std::move(vectors)};
}

/// Transformed pairs sum_kl T_kj T_li list[k, l].
template <class Term>
std::vector<Term> transformed_pairs(const std::vector<Term>& list, const MatrixXd& T) {
  const Index m = T.rows();
  std::vector<Term> half(list.size(), Term::Zero());
  for (Index j = 0; j < m; ++j)
    for (Index l = 0; l < m; ++l)
      for (Index k = 0; k < m; ++k) half[place(j * m + l)] += T(k, j) * list[place(k * m + l)];
  std::vector<Term> result(list.size(), Term::Zero());
  for (Index j = 0; j < m; ++j)
    for (Index i = 0; i < m; ++i)
      for (Index l = 0; l < m; ++l) result[place(j * m + i)] += T(l, i) * half[place(j * m + l)];
  return result;
}

InertiaInvariants transformed(const InertiaInvariants& given, const MatrixXd& T) {
  InertiaInvariants result = given;
  result.S2 = given.S2 * T;
  result.N0 = given.N0 * T;
  result.Maa = T.transpose() * given.Maa * T;
  for (Index l = 0; l < T.cols(); ++l) {
    result.G0[place(l)].setZero();
    for (Index k = 0; k < T.rows(); ++k) result.G0[place(l)] += T(k, l) * given.G0[place(k)];
  }
  result.G = transformed_pairs(given.G, T);
  result.N = transformed_pairs(given.N, T);
  return result;
}

/// Makes the identities among the invariants (modal_body_check.h), which hold to the digits of a
/// file, hold to rounding.
void make_consistent(InertiaInvariants& inertia) {
  const auto cross_of = [](const Eigen::Matrix3d& g) {
    return Eigen::Vector3d(g(1, 2) - g(2, 1), g(2, 0) - g(0, 2), g(0, 1) - g(1, 0));
  };
  inertia.J0 = ((inertia.J0 + inertia.J0.transpose()) / 2).eval();
  const Index m = inertia.Maa.rows();
  for (Index l = 0; l < m; ++l) {
    inertia.N0.col(l) = cross_of(inertia.G0[place(l)]);
    for (Index j = 0; j <= l; ++j) {
      Eigen::Matrix3d& G = inertia.G[place(j * m + l)];
      Eigen::Matrix3d& across = inertia.G[place(l * m + j)];
      const Eigen::Matrix3d mean = (G + across.transpose()) / 2;
      G = mean;
      across = mean.transpose();
      inertia.N[place(j * m + l)] = cross_of(G);
      inertia.N[place(l * m + j)] = cross_of(across);
    }
  }
}

double largest(const Eigen::Matrix3d& matrix) { return matrix.cwiseAbs().maxCoeff(); }

/// Checks data of a file that repeats parts of G0 and G: N0 and N, and the generalised mass.
void check_agreement(const InertiaInvariants& inertia) {
  const Index m = inertia.Maa.rows();
  for (Index l = 0; l < m; ++l) {
    const std::string mode = "mode " + std::to_string(l + 1);
    const Eigen::Matrix3d& G0 = inertia.G0[place(l)];
    const Eigen::Vector3d N0 = inertia.N0.col(l);
    require_agreement("the Coriolis and the rotational coupling terms of " + mode,
                      largest(inertia_integral(G0, N0) - G0), G0.norm() + N0.norm());
    for (Index j = 0; j < m; ++j) {
      const std::string modes = "mode " + std::to_string(j + 1) + " with " + mode;
      const Eigen::Matrix3d& G = inertia.G[place(j * m + l)];
      const double scale = std::sqrt(inertia.Maa(j, j) * inertia.Maa(l, l));
      require_agreement("the centrifugal terms and the generalised mass of " + modes,
                        G.trace() / 2 - inertia.Maa(j, l), scale);
      require_agreement("the centrifugal and the rotational coupling terms of " + modes,
                        largest(inertia_integral(G, inertia.N[place(j * m + l)]) - G), scale);
    }
  }
}

std::string damping_note(const MatrixXd& damping, const Eigen::VectorXd& omega) {
  std::string list;
  for (Index k = 0; k < omega.size(); ++k)
    list +=
        (k == 0 ? "" : ", ") + text_within(omega[k] > 0 ? damping(k, k) / (2 * omega[k]) : 0, 12);
  MatrixXd coupling = damping;
  coupling.diagonal().setZero();
  const bool couples =
      coupling.cwiseAbs().maxCoeff() > kAgree * damping.diagonal().cwiseAbs().maxCoeff();
  return "the damping of the file is not part of a modal body; set it in the model, with "
         "damping_ratio = [" +
         list + "]" + (couples ? "; its coupling of modes is lost" : "");
}

std::vector<ModeRecord> records_of(const ReducedBody& reduced, const Spectrum& spectrum,
                                   const Eigen::VectorXd& hertz) {
  std::vector<ModeRecord> records = reduced.modes;
  records.resize(place(hertz.size()));
  for (std::size_t k = 0; k < records.size(); ++k) {
    if (!spectrum.is_as_given || records[k].name.empty())
      records[k] = {"mode " + std::to_string(k + 1), std::string(kNormalMode)};
    const bool is_rigid = hertz[static_cast<Index>(k)] == 0;
    if (is_rigid != (records[k].kind == kRigidMode))
      records[k].kind = is_rigid ? kRigidMode : kNormalMode;
  }
  return records;
}

Eigen::VectorXd angular_frequencies(const Eigen::VectorXd& squares) {
  const double largest = squares.cwiseAbs().maxCoeff();
  Eigen::VectorXd omega(squares.size());
  for (Index k = 0; k < squares.size(); ++k) {
    if (squares[k] < -kNothing * largest)
      throw InputError(
          "expected a positive semidefinite generalised stiffness matrix, found a negative value "
          "for mode " +
          std::to_string(k + 1));
    omega[k] = squares[k] > kNothing * largest ? std::sqrt(squares[k]) : 0;
  }
  return omega;
}

void add_nodes(const ReducedBody& reduced, const MatrixXd& T, ModalBody& body) {
  for (const Interface& node : reduced.nodes)
    body.interfaces.push_back(
        {node.name, node.position_m, node.translation * T, node.rotation * T});
  const auto n = static_cast<Index>(reduced.nodes.size());
  body.nodes_m.resize(3, n);
  for (Index k = 0; k < n; ++k) body.nodes_m.col(k) = reduced.nodes[place(k)].position_m;
  for (Index l = 0; l < T.cols(); ++l) {
    Eigen::Matrix3Xd shape(3, n);
    for (Index k = 0; k < n; ++k) shape.col(k) = body.interfaces[place(k)].translation.col(l);
    body.shapes.push_back(std::move(shape));
  }
}

}  // namespace

ImportedModes import_modes(const ReducedBody& reduced) {
  if (reduced.nodes.empty())
    throw InputError("expected at least one node at which other bodies attach, found none");
  const Spectrum spectrum = spectrum_of(reduced);
  check_agreement(reduced.invariants);
  const MatrixXd& T = spectrum.vectors;
  const Eigen::VectorXd omega = angular_frequencies(spectrum.squares);
  ImportedModes result{.body = {}, .notes = reduced.notes};
  ModalBody& body = result.body;
  body.frequencies_Hz = omega / (2 * std::numbers::pi);
  body.modes = records_of(reduced, spectrum, body.frequencies_Hz);
  body.boundary = "imported";
  body.completeness = "not checked";
  body.solver = spectrum.is_as_given ? "" : "reduced eigenproblem of the imported modes";
  body.invariants = spectrum.is_as_given ? reduced.invariants : transformed(reduced.invariants, T);
  const MatrixXd& mass = body.invariants.Maa;
  body.orthogonality = (mass - MatrixXd::Identity(mass.rows(), mass.cols())).cwiseAbs().maxCoeff();
  make_consistent(body.invariants);
  add_nodes(reduced, T, body);
  if (!spectrum.is_as_given)
    result.notes.emplace_back(
        "the modes of the file are coupled by mass or stiffness; they are replaced by uncoupled "
        "combinations with new numbers");
  const MatrixXd damping = T.transpose() * reduced.damping * T;
  if (!damping.isZero(0)) result.notes.push_back(damping_note(damping, omega));
  check_modal_body(body);
  return result;
}

Eigen::Matrix3d inertia_integral(const Eigen::Matrix3d& symmetric, const Eigen::Vector3d& cross) {
  return (symmetric + symmetric.transpose() - skew(cross)) / 2;
}

void require_agreement(const std::string& these, double difference, double scale) {
  if (std::abs(difference) <= kAgree * std::abs(scale)) return;
  throw InputError(these + " differ by " + text_within(std::abs(difference), 10) +
                   ", although their values are about " + text_within(std::abs(scale), 10) +
                   ", and they must belong to the same mass distribution");
}

std::string text_of_mode(const ModeRecord& mode) { return mode.name + ", " + mode.kind; }

ModeRecord mode_of_text(const std::string& text) {
  const std::size_t comma = text.rfind(", ");
  if (comma == std::string::npos || comma == 0) return {};
  const std::string kind = text.substr(comma + 2);
  if (std::find(kKinds.begin(), kKinds.end(), kind) == kKinds.end()) return {};
  return {text.substr(0, comma), kind};
}

}  // namespace flexneck::fe_modal
