// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/body/modal_body_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Geometry>
#include <Eigen/QR>

#include "fe_modal/body/basis_kind.h"
#include "fe_modal/body/identity.h"
#include "fe_modal/body/modal_body.h"
#include "fe_modal/body/skew.h"
#include "geometry/foundation/error.h"
#include "geometry/foundation/names.h"
#include "geometry/foundation/output_file.h"

namespace flexneck::fe_modal {

namespace {

/// Largest accepted |Maa - I| and |tr G / 2 - Maa|.
inline constexpr double kMassNormalised = 1e-6;

/// Returns int rho p q^T from -int rho ~p ~q.
Eigen::Matrix3d products_of(const Eigen::Matrix3d& inertia_integral) {
  return inertia_integral.trace() / 2 * Eigen::Matrix3d::Identity() - inertia_integral.transpose();
}

/// Returns int rho p x q from -int rho ~p ~q.
Eigen::Vector3d cross_integral(const Eigen::Matrix3d& inertia_integral) {
  const Eigen::Matrix3d& g = inertia_integral;
  return {g(1, 2) - g(2, 1), g(2, 0) - g(0, 2), g(0, 1) - g(1, 0)};
}

std::string entry_of(std::size_t j, std::size_t l) {
  return entry_text(static_cast<Eigen::Index>(j), static_cast<Eigen::Index>(l));
}

/// Checks the identities of G and N for a pair of modes.
void check_pair(const InertiaInvariants& inertia, std::size_t j, std::size_t l, double rounding) {
  const auto m = static_cast<std::size_t>(inertia.Maa.rows());
  const std::string here = entry_of(j, l);
  const std::string there = entry_of(l, j);
  const Eigen::Matrix3d& g = inertia.G[j * m + l];
  const Eigen::Vector3d& n = inertia.N[j * m + l];
  require_identity("/invariants/G", here + " is the transpose of " + there,
                   (g - inertia.G[l * m + j].transpose()).cwiseAbs().maxCoeff(), rounding);
  require_identity(
      "/invariants/G", "half the trace of " + here + " is that entry of Maa",
      g.trace() / 2 - inertia.Maa(static_cast<Eigen::Index>(j), static_cast<Eigen::Index>(l)),
      kMassNormalised);
  require_identity("/invariants/N", here + " is minus " + there,
                   (n + inertia.N[l * m + j]).cwiseAbs().maxCoeff(), rounding);
  require_identity("/invariants/N", here + " matches the antisymmetric part of G" + here,
                   (n - cross_integral(g)).cwiseAbs().maxCoeff(), 2 * rounding);
}

/// Matrix of int rho p q of the scalar fields 1, the components of s0, those of psi_0, …; s0 is
/// scaled so that int rho |s0|^2 = 1, and 1 so that the mass is 1.
Eigen::MatrixXd gram_matrix(const InertiaInvariants& inertia, double length) {
  const auto m = inertia.Maa.rows();
  const double root_mass = std::sqrt(inertia.mass);
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(4 + 3 * m, 4 + 3 * m);
  gram(0, 0) = 1;
  gram.block<3, 1>(1, 0) = inertia.S1 / (root_mass * length);
  gram.block<3, 3>(1, 1) = products_of(inertia.J0) / (length * length);
  for (Eigen::Index l = 0; l < m; ++l) {
    gram.block<3, 1>(4 + 3 * l, 0) = inertia.S2.col(l) / root_mass;
    gram.block<3, 3>(4 + 3 * l, 1) =
        products_of(inertia.G0[static_cast<std::size_t>(l)]).transpose() / length;
    for (Eigen::Index j = l; j < m; ++j) {
      gram.block<3, 3>(4 + 3 * j, 4 + 3 * l) =
          products_of(inertia.G[static_cast<std::size_t>(j * m + l)]);
    }
  }
  return gram.selfadjointView<Eigen::Lower>();
}

/// Checks that the matrix is positive, block after block, so that the message names the one in
/// error.
void check_gram(const Eigen::MatrixXd& gram, double rounding) {
  const Eigen::Index size = gram.rows();
  const double allowed = static_cast<double>(size) * rounding;
  require_positive("/invariants/J0", "the matrix of the second moments of mass, S1 and J0",
                   gram.topLeftCorner<4, 4>(), allowed);
  require_positive("/invariants/G", "the mass matrix of the modes' components",
                   gram.bottomRightCorner(size - 4, size - 4), allowed);
  std::vector<Eigen::Index> without_positions = {0};
  for (Eigen::Index k = 4; k < size; ++k) without_positions.push_back(k);
  require_positive("/invariants/S2", "the mass matrix of translations and modes",
                   gram(without_positions, without_positions), allowed);
  require_positive("/invariants/G0", "the mass matrix of translations, rotations and modes", gram,
                   allowed);
}

/// Rounding error of sums of n products of double precision, as the invariants are, relative to the
/// largest value that they can have by the inequality of Schwarz. A consistent mass couples a node
/// with up to about a hundred others, and either side of an identity rounds.
double rounding_of_sums(Eigen::Index n) {
  constexpr double kCoupled = 100;
  constexpr double kFacets = 2;
  return kFacets * (static_cast<double>(n) + kCoupled) * std::numeric_limits<double>::epsilon();
}

/// Checks the identities among the inertia invariants of a body, as sums of products over the same
/// masses:
///   J0 = J0^T, Maa = I = (tr G_jl / 2), G_jl = G_lj^T, N_jl = -N_lj
///   N0_l and N_jl have the antisymmetric parts of G0_l and G_jl
///   The integrals int rho p q of the fields 1, s0 and psi follow from m, S1, S2, J0, G0 and G.
///   Their matrix is positive semidefinite. This implies the parallel axis theorem, the triangle
///   inequality of moments of inertia, effective masses that are not above the mass, and a mass
///   matrix that is positive semidefinite for any deformation.
/// @param rounding rounding_of_sums()
/// @throws InputError "<dataset>: …" with the entry, by how much it is off, and what is allowed.
void check_invariants(const InertiaInvariants& inertia, double rounding) {
  const auto m = static_cast<std::size_t>(inertia.Maa.rows());
  const auto identity = Eigen::MatrixXd::Identity(inertia.Maa.rows(), inertia.Maa.cols());
  if (!(inertia.mass > 0)) throw InputError("/invariants/mass: the mass is not positive");
  if ((inertia.Maa - identity).cwiseAbs().maxCoeff() > kMassNormalised) {
    throw InputError("/invariants/Maa: the modes are not mass-normalised, expected the identity");
  }
  const double second_moment = inertia.J0.trace() / 2;
  if (!(second_moment > 0)) {
    throw InputError("/invariants/J0: expected moments of inertia with a positive sum");
  }
  require_symmetric("/invariants/J0", inertia.J0, rounding * second_moment);
  const double length = std::sqrt(second_moment);
  for (std::size_t l = 0; l < m; ++l) {
    const auto column = static_cast<Eigen::Index>(l);
    require_identity("/invariants/N0",
                     "column " + std::to_string(l) + " matches the antisymmetric part of G0[" +
                         std::to_string(l) + "]",
                     (inertia.N0.col(column) - cross_integral(inertia.G0[l])).cwiseAbs().maxCoeff(),
                     2 * rounding * length);
    for (std::size_t j = 0; j <= l; ++j) check_pair(inertia, j, l, rounding);
  }
  check_gram(gram_matrix(inertia, length), rounding);
}

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

/// Accuracy of solutions: iterations solve for static shapes and for rigid motions to 1e-8.
constexpr double kSolved = 1e-6;
/// Relative difference within which equal frequencies may be in any order.
constexpr double kEqual = 1e-9;
/// Highest possible frequency: the fastest sound in any solid, 36 km/s, over twice the distance of
/// atoms, 0.1 nm.
constexpr double kHighestHz = 2e14;

void check_modes(const ModalBody& body) {
  constexpr std::array kKinds = {kNormalMode, kRigidMode, kResidualMode,
                                 kReliefMode, kRitzMode,  kConstraintMode};
  try {
    check_names(names_of(body.modes), "mode");
  } catch (const InputError& error) {
    throw InputError(std::string("/mode_names: ") + error.what());
  }
  double before = 0;
  for (Eigen::Index k = 0; k < body.mode_count(); ++k) {
    const std::string& kind = body.modes[static_cast<std::size_t>(k)].kind;
    const double hertz = body.frequencies_Hz[k];
    const auto refuse = [&](const std::string& expected) {
      throw InputError("/frequencies: [" + std::to_string(k) + "] is " + rounded_text(hertz) +
                       " Hz, expected " + expected);
    };
    if (std::find(kKinds.begin(), kKinds.end(), kind) == kKinds.end()) {
      throw InputError("/basis/kind: [" + std::to_string(k) + "] is '" + kind +
                       "', expected normal, rigid, residual, inertia relief, ritz or constraint");
    }
    if (!(hertz >= 0 && hertz <= kHighestHz))
      refuse("a non-negative frequency of a physically possible size");
    if (kind == kRigidMode && hertz != 0) refuse("0, since its kind is rigid");
    if (kind != kRigidMode && hertz == 0) refuse("more than 0, since its kind is not rigid");
    if (hertz < before * (1 - kEqual))
      refuse("at least the one before it, " + rounded_text(before));
    before = hertz;
  }
}

/// Fits rigid motions to fields on nodes.
class RigidFit {
 public:
  explicit RigidFit(const Eigen::Matrix3Xd& nodes_m)
      : center_(nodes_m.rowwise().mean()), relative_(nodes_m.colwise() - center_) {
    length_ = std::sqrt(relative_.squaredNorm() / static_cast<double>(relative_.cols()));
    if (length_ == 0) length_ = 1;
    Matrix6d gram = Matrix6d::Zero();
    for (const auto& node : relative_.colwise()) {
      const auto rows = motion_of(node);
      gram += rows.transpose() * rows;
    }
    factor_.compute(gram);
  }

  /// True if rotations are unique: unless all nodes lie on a line.
  bool is_unique() const { return factor_.rank() == 6; }

  /// Translation of the nodes' centre, then rotation times a length.
  Vector6d of(const Eigen::Matrix3Xd& field) const {
    Vector6d loads = Vector6d::Zero();
    for (Eigen::Index k = 0; k < relative_.cols(); ++k) {
      loads += motion_of(relative_.col(k)).transpose() * field.col(k);
    }
    return factor_.solve(loads);
  }
  Eigen::Vector3d rotation(const Vector6d& motion) const { return motion.tail<3>() / length_; }
  Eigen::Vector3d translation(const Vector6d& motion, const Eigen::Vector3d& of_point) const {
    return motion_of(of_point - center_) * motion;
  }
  double length() const { return length_; }

 private:
  Eigen::Matrix<double, 3, 6> motion_of(const Eigen::Vector3d& from_center) const {
    return rigid_motions_at(from_center / length_);
  }

  Eigen::Vector3d center_;
  Eigen::Matrix3Xd relative_;
  double length_ = 1;
  Eigen::CompleteOrthogonalDecomposition<Matrix6d> factor_;
};

void check_rigid_mode(const ModalBody& body, const RigidFit& fit, Eigen::Index k) {
  const Eigen::Matrix3Xd& shape = body.shapes[static_cast<std::size_t>(k)];
  const Vector6d motion = fit.of(shape);
  const double size = motion.norm();
  const std::string mode = "rigid mode " + std::to_string(k);
  double off = 0;
  for (Eigen::Index n = 0; n < shape.cols(); ++n) {
    off = std::max(off, (shape.col(n) - fit.translation(motion, body.nodes_m.col(n))).norm());
  }
  require_identity("/shapes", mode + " moves all nodes as one rigid body", off, kSolved * size);
  for (const Interface& interface : body.interfaces) {
    const std::string group = "/interfaces/" + interface.name;
    const Eigen::Vector3d translation = fit.translation(motion, interface.position_m);
    const double arm = 1 + translation.norm() / size;
    require_identity(group + "/translation", mode + " moves the interface with the nodes",
                     (interface.translation.col(k) - translation).norm(), kSolved * size * arm);
    if (!fit.is_unique()) continue;
    require_identity(group + "/rotation", mode + " rotates the interface with the nodes",
                     (interface.rotation.col(k) - fit.rotation(motion)).norm(),
                     kSolved * size / fit.length());
  }
  if (!fit.is_unique()) return;
  const InertiaInvariants& inertia = body.invariants;
  const Eigen::Vector3d turn = fit.rotation(motion);
  const Eigen::Vector3d at_origin = fit.translation(motion, Eigen::Vector3d::Zero());
  require_identity("/invariants/S2", mode + " moves mass and S1 as one rigid body",
                   (inertia.S2.col(k) - inertia.mass * at_origin - turn.cross(inertia.S1)).norm(),
                   kSolved * std::sqrt(inertia.mass));
  require_identity("/invariants/N0", mode + " rotates S1 and J0 as one rigid body",
                   (inertia.N0.col(k) - inertia.S1.cross(at_origin) - inertia.J0 * turn).norm(),
                   kSolved * std::sqrt(inertia.J0.trace() / 2));
}

void check_rigid_modes(const ModalBody& body) {
  const auto rigid = static_cast<Eigen::Index>((body.frequencies_Hz.array() == 0).count());
  if (rigid == 0) return;
  const RigidFit fit(body.nodes_m);
  for (Eigen::Index k = 0; k < rigid; ++k) check_rigid_mode(body, fit, k);
}

/// Checks that a matrix is symmetric and positive, whatever the units of its rows.
void check_positive(const std::string& dataset, const std::string& what, const Matrix6d& matrix) {
  const Eigen::VectorXd scales = unit_scales(dataset, matrix);
  const Eigen::MatrixXd scaled = scales.asDiagonal() * matrix * scales.asDiagonal();
  require_symmetric(dataset, scaled, kSolved);
  require_positive(dataset, what, scaled, 6 * kSolved);
}

void check_response(const ModalBody& body, const Interface& interface) {
  const std::string group = "/interfaces/" + interface.name;
  const Matrix6d& compliance = interface.response->compliance;
  check_positive(group + "/compliance", "the compliance", compliance);
  check_positive(group + "/response_mass", "the mass", interface.response->mass);
  Matrix6d rest = compliance;
  for (Eigen::Index k = 0; k < body.mode_count(); ++k) {
    if (body.frequencies_Hz[k] == 0) continue;
    Vector6d motion;
    motion << interface.translation.col(k), interface.rotation.col(k);
    motion /= 2 * std::numbers::pi * body.frequencies_Hz[k];
    rest -= motion * motion.transpose();
  }
  const Eigen::VectorXd scales = unit_scales(group + "/compliance", compliance);
  require_positive(group + "/compliance", "the static compliance minus that of the modes",
                   scales.asDiagonal() * rest * scales.asDiagonal(), 6 * kSolved);
}

void check_attached(const ModalBody& body, const AttachedFrequencies& attached) {
  const std::string group = "/attached/" + attached.body;
  try {
    static_cast<void>(body.interface(attached.interface));
  } catch (const InputError& error) {
    throw InputError(group + ": " + error.what());
  }
  const Eigen::VectorXd& hertz = attached.frequencies_Hz;
  if (!(hertz.array() > 0).all() || !std::is_sorted(hertz.begin(), hertz.end())) {
    throw InputError(group + "/frequencies: expected positive numbers in ascending order");
  }
  if (attached.mass_matrix) {
    check_positive(group + "/mass_matrix", "the mass of a rigid body", *attached.mass_matrix);
  }
}

void check_geometric(const std::string& dataset, const std::vector<Eigen::MatrixXd>& matrices) {
  for (std::size_t k = 0; k < matrices.size(); ++k) {
    const double largest = matrices[k].size() == 0 ? 0 : matrices[k].cwiseAbs().maxCoeff();
    require_symmetric("/geometric_stiffness/" + dataset + ": matrix " + std::to_string(k),
                      matrices[k], kSolved * largest);
  }
}

void check_geometric_stiffness(const ModalBody& body) {
  if (!body.geometric_stiffness) return;
  const GeometricStiffness& stiffness = *body.geometric_stiffness;
  check_geometric("acceleration", stiffness.acceleration);
  check_geometric("angular_acceleration", stiffness.angular_acceleration);
  check_geometric("velocity_products", stiffness.velocity_products);
  check_geometric("modal_acceleration", stiffness.modal_acceleration);
  for (const GeometricStiffness::OfInterface& loads : stiffness.interfaces) {
    check_geometric("interfaces/" + loads.name + "/force", loads.force);
    check_geometric("interfaces/" + loads.name + "/moment", loads.moment);
  }
}

}  // namespace

void check_modal_body(const ModalBody& body) {
  check_modes(body);
  check_invariants(body.invariants, rounding_of_sums(body.nodes_m.cols()));
  check_rigid_modes(body);
  for (const Interface& interface : body.interfaces) {
    if (interface.response) check_response(body, interface);
  }
  for (const AttachedFrequencies& attached : body.attached) check_attached(body, attached);
  check_geometric_stiffness(body);
}

}  // namespace flexneck::fe_modal
