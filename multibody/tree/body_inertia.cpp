// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/tree/body_inertia.h"

#include "multibody/numerics/rotation.h"

namespace flexneck::multibody::tree {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

Vector6d packed(const Matrix3d& symmetric) {
  Vector6d values;
  values << symmetric(0, 0), symmetric(1, 1), symmetric(2, 2), symmetric(0, 1), symmetric(0, 2),
      symmetric(1, 2);
  return values;
}

template <typename Packed>
Matrix3d unpacked(const Packed& v) {
  Matrix3d symmetric;
  symmetric << v[0], v[3], v[4], v[3], v[1], v[5], v[4], v[5], v[2];
  return symmetric;
}

/// Coefficients that turn packed J into w . J w.
Vector6d quadratic_form(const Vector3d& w) {
  Vector6d values;
  values << w[0] * w[0], w[1] * w[1], w[2] * w[2], 2 * w[0] * w[1], 2 * w[0] * w[2],
      2 * w[1] * w[2];
  return values;
}

}  // namespace

BodyInertia::BodyInertia(const RigidBody& body)
    : mass(body.mass_kg), S1(body.mass_kg * body.center_m), S2(3, 0), D(6, 0), N0(3, 0) {
  const Vector3d& c = body.center_m;
  J0 = packed(body.inertia_kg_m2 +
              mass * (c.squaredNorm() * Matrix3d::Identity() - c * c.transpose()));
}

BodyInertia::BodyInertia(const DeformableBody& body) : slopes(inertia_slopes(body)), springs(body) {
  const fe_modal::InertiaInvariants& from = body.modes.invariants;
  const Index m = body.modes.mode_count();
  mass = from.mass;
  S1 = from.S1;
  S2 = from.S2;
  J0 = packed(from.J0);
  N0 = from.N0;
  Maa = from.Maa;
  D.resize(6, m);
  E.resize(6 * m, m);
  N.resize(3 * m, m);
  for (Index l = 0; l < m; ++l) {
    const Matrix3d& G0 = from.G0[static_cast<std::size_t>(l)];
    D.col(l) = packed(G0 + G0.transpose());
    for (Index j = 0; j < m; ++j) {
      const auto jl = static_cast<std::size_t>(j * m + l);
      E.block<6, 1>(6 * l, j) =
          packed(from.G[jl] + from.G[jl].transpose() + 2 * inertia_curvature(body, j, l));
      N.block<3, 1>(3 * l, j) = from.N[jl];
    }
  }
}

InertiaTerms::InertiaTerms(const BodyInertia& body)
    : M_rr(Matrix6d::Zero()),
      M_ra(6, body.mode_count()),
      M_aa(body.mode_count(), body.mode_count()),
      bias_r(Vector6d::Zero()),
      bias_a(body.mode_count()) {}

namespace {

/// Contributions of the modes to the first moment, to the moment of inertia and to their rates.
struct ModalSums {
  Vector3d S;
  Vector6d J;
  Vector6d J_dot = Vector6d::Zero();
  Vector3d momentum = Vector3d::Zero();  ///< S2 a'
  Vector3d angular = Vector3d::Zero();   ///< N a'
};

/// Adds the whole contribution of mode l, in one pass over its invariants: small sums stay in
/// registers.
[[gnu::always_inline]] inline void add_mode(const BodyInertia& body, const VectorXd& a,
                                            const VectorXd& a_rate, const Vector3d& w,
                                            const Vector6d& form, Index l, ModalSums& sums,
                                            InertiaTerms& terms) {
  const Index m = body.mode_count();
  Vector6d slope = body.D.col(l);
  Vector3d N_l = body.N0.col(l);
  Vector3d N_rate = Vector3d::Zero();
  for (Index j = 0; j < m; ++j) {
    slope += a[j] * body.E.block<6, 1>(6 * l, j);
    const Vector3d N_jl = body.N.block<3, 1>(3 * l, j);
    N_l += a[j] * N_jl;
    N_rate += a_rate[j] * N_jl;
  }
  const Vector3d S2_l = body.S2.col(l);
  terms.M_ra.block<3, 1>(0, l) = S2_l;
  terms.M_ra.block<3, 1>(3, l) = N_l;
  terms.bias_a[l] = 2 * w.dot(N_rate) - 0.5 * form.dot(slope) +
                    (body.stiffens() ? 0 : body.springs.load(l, a[l], a_rate[l]));
  sums.S += a[l] * S2_l;
  // J = J0 + D a + E a a / 2 = J0 + (D + dJ/da) a / 2.
  sums.J += (0.5 * a[l]) * (body.D.col(l) + slope);
  sums.J_dot += a_rate[l] * slope;
  sums.momentum += a_rate[l] * S2_l;
  sums.angular += a_rate[l] * N_l;
}

/// Adds the changes of S2 and N with the deformation.
void add_slopes_of_inertia(const BodyInertia& body, const VectorXd& a, const VectorXd& a_rate,
                           ModalSums& sums, InertiaTerms& terms) {
  auto S2 = terms.M_ra.topRows<3>();
  auto N = terms.M_ra.bottomRows<3>();
  add_slopes(body.slopes.S2, a, S2);
  add_slopes(body.slopes.N, a, N);
  sums.S += 0.5 * contracted(body.slopes.S2, a, a);
  sums.momentum += contracted(body.slopes.S2, a, a_rate);
  sums.angular += contracted(body.slopes.N, a, a_rate);
}

}  // namespace

void update(const BodyInertia& body, const VectorXd& a, const VectorXd& a_rate, const Vector3d& w,
            InertiaTerms& terms) {
  ModalSums sums{body.S1, body.J0};
  const Index m = body.mode_count();
  if (m > 0) {
    const Vector6d form = quadratic_form(w);
    for (Index l = 0; l < m; ++l) add_mode(body, a, a_rate, w, form, l, sums, terms);
    if (body.stiffens()) {
      add_slopes_of_inertia(body, a, a_rate, sums, terms);
      body.springs.add_loads(a, a_rate, 1, terms.bias_a);
    }
    body.springs.add_gap_loads(a, 1, terms.bias_a);
    terms.M_aa = body.Maa;
  }
  const Matrix3d inertia = unpacked(sums.J);
  const Matrix3d crossed = skew(sums.S);
  terms.M_rr.topLeftCorner<3, 3>() = body.mass * Matrix3d::Identity();
  terms.M_rr.topRightCorner<3, 3>() = -crossed;
  terms.M_rr.bottomLeftCorner<3, 3>() = crossed;
  terms.M_rr.bottomRightCorner<3, 3>() = inertia;

  // Rates of momentum and of angular momentum.
  const Vector3d momentum = w.cross(sums.S) + 2 * sums.momentum;
  const Vector3d angular = inertia * w + sums.angular;
  terms.bias_r.head<3>() = w.cross(momentum);
  terms.bias_r.tail<3>() = w.cross(angular);
  if (m > 0) terms.bias_r.tail<3>() += unpacked(sums.J_dot) * w;
  if (body.stiffens()) {
    terms.bias_r.head<3>() += contracted(body.slopes.S2, a_rate, a_rate);
    terms.bias_r.tail<3>() += contracted(body.slopes.N, a_rate, a_rate);
  }
}

void update_modes(const BodyInertia& body, const VectorXd& a, const VectorXd& a_rate,
                  InertiaTerms& terms) {
  for (Index l = 0; l < body.mode_count(); ++l) {
    terms.M_ra.block<3, 1>(0, l) = body.S2.col(l);
    terms.M_ra.block<3, 1>(3, l).setZero();
    terms.bias_a[l] = body.springs.load(l, a[l], a_rate[l]);
  }
  body.springs.add_gap_loads(a, 1, terms.bias_a);
  terms.M_aa = body.Maa;
  terms.M_rr.setZero();
  terms.M_rr.topLeftCorner<3, 3>().diagonal().setConstant(body.mass);
  terms.bias_r.setZero();
}

void update_rigid_bias(const BodyInertia& body, const Vector3d& w, InertiaTerms& terms) {
  terms.bias_r.head<3>() = w.cross(w.cross(body.S1));
  terms.bias_r.tail<3>() = w.cross(terms.M_rr.bottomRightCorner<3, 3>() * w);
}

double kinetic_energy_J(const BodyInertia& body, const VectorXd& a, const VectorXd& a_rate,
                        const Vector3d& v, const Vector3d& w) {
  const Index m = body.mode_count();
  Vector3d S = body.S1;
  Vector6d J = body.J0;
  Vector3d momentum = Vector3d::Zero();  // momentum of the deformation alone
  Vector3d angular = Vector3d::Zero();
  double deformation = 0;
  for (Index l = 0; l < m; ++l) {
    S += a[l] * body.S2.col(l);
    J += a[l] * body.D.col(l);
    momentum += a_rate[l] * body.S2.col(l);
    angular += a_rate[l] * body.N0.col(l);
    for (Index j = 0; j < m; ++j) {
      J += (0.5 * a[j] * a[l]) * body.E.block<6, 1>(6 * l, j);
      angular += (a_rate[l] * a[j]) * body.N.block<3, 1>(3 * l, j);
      deformation += a_rate[l] * a_rate[j] * body.Maa(l, j);
    }
  }
  if (body.stiffens()) {
    S += 0.5 * contracted(body.slopes.S2, a, a);
    momentum += contracted(body.slopes.S2, a, a_rate);
    angular += contracted(body.slopes.N, a, a_rate);
  }
  return 0.5 * (body.mass * v.squaredNorm() + w.dot(unpacked(J) * w) + deformation) +
         v.dot(w.cross(S) + momentum) + w.dot(angular);
}

}  // namespace flexneck::multibody::tree
