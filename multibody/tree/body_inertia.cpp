// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/tree/body_inertia.h"

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

/// What turns packed J into w . J w.
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

BodyInertia::BodyInertia(const DeformableBody& body) : springs(body) {
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
      E.block<6, 1>(6 * l, j) = packed(from.G[jl] + from.G[jl].transpose());
      N.block<3, 1>(3 * l, j) = from.N[jl];
    }
  }
}

InertiaTerms::InertiaTerms(const BodyInertia& body)
    : M_rr(Matrix6d::Zero()),
      M_ra(6, body.mode_count()),
      M_aa(body.mode_count(), body.mode_count()),
      bias_r(Vector6d::Zero()),
      bias_a(body.mode_count()),
      J_rate(6, body.mode_count()),
      packed(3 * body.mode_count()) {}

void update(const BodyInertia& body, const VectorXd& a, const VectorXd& a_rate, const Vector3d& w,
            InertiaTerms& terms) {
  const Index m = body.mode_count();
  terms.S = body.S1;
  Vector6d J = body.J0;
  if (m > 0) {
    for (Index j = 0; j < m; ++j) terms.S += a[j] * body.S2.col(j);
    Eigen::Map<VectorXd> slopes(terms.J_rate.data(), 6 * m);
    slopes = Eigen::Map<const VectorXd>(body.D.data(), 6 * m);
    for (Index j = 0; j < m; ++j) slopes += a[j] * body.E.col(j);
    // J = J0 + D a + E a a / 2 = J0 + (D + dJ/da) a / 2.
    for (Index l = 0; l < m; ++l) J += (0.5 * a[l]) * (body.D.col(l) + terms.J_rate.col(l));
    terms.M_aa = body.Maa;
    terms.M_ra.topRows<3>() = body.S2;
    terms.packed = Eigen::Map<const VectorXd>(body.N0.data(), 3 * m);
    for (Index j = 0; j < m; ++j) terms.packed += a[j] * body.N.col(j);
    for (Index l = 0; l < m; ++l) terms.M_ra.block<3, 1>(3, l) = terms.packed.segment<3>(3 * l);
  }
  const Matrix3d inertia = unpacked(J);
  const Vector3d& S = terms.S;
  Matrix3d crossed;
  crossed << 0, -S.z(), S.y(), S.z(), 0, -S.x(), -S.y(), S.x(), 0;
  terms.M_rr.topLeftCorner<3, 3>() = body.mass * Matrix3d::Identity();
  terms.M_rr.topRightCorner<3, 3>() = -crossed;
  terms.M_rr.bottomLeftCorner<3, 3>() = crossed;
  terms.M_rr.bottomRightCorner<3, 3>() = inertia;

  // Rates of momentum and of angular momentum, and of the modes' momenta less dT/da.
  Vector3d momentum = w.cross(S);
  Vector3d angular = inertia * w;
  Vector3d change = Vector3d::Zero();
  if (m > 0) {
    Vector6d J_dot = Vector6d::Zero();
    for (Index l = 0; l < m; ++l) {
      momentum += (2 * a_rate[l]) * body.S2.col(l);
      angular += a_rate[l] * terms.M_ra.block<3, 1>(3, l);
      J_dot += a_rate[l] * terms.J_rate.col(l);
    }
    change = unpacked(J_dot) * w;
    terms.packed = a_rate[0] * body.N.col(0);
    for (Index j = 1; j < m; ++j) terms.packed += a_rate[j] * body.N.col(j);
    const Vector6d form = quadratic_form(w);
    for (Index l = 0; l < m; ++l)
      terms.bias_a[l] = 2 * w.dot(terms.packed.segment<3>(3 * l)) -
                        0.5 * form.dot(terms.J_rate.col(l)) + body.springs.load(l, a[l], a_rate[l]);
  }
  terms.bias_r.head<3>() = w.cross(momentum);
  terms.bias_r.tail<3>() = change + w.cross(angular);
}

double kinetic_energy_J(const BodyInertia& body, const VectorXd& a, const VectorXd& a_rate,
                        const Vector3d& v, const Vector3d& w) {
  const Index m = body.mode_count();
  Vector3d S = body.S1;
  Vector6d J = body.J0;
  Vector3d momentum = Vector3d::Zero();  // of the deformation alone
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
  return 0.5 * (body.mass * v.squaredNorm() + w.dot(unpacked(J) * w) + deformation) +
         v.dot(w.cross(S) + momentum) + w.dot(angular);
}

}  // namespace flexneck::multibody::tree
