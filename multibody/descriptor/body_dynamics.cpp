// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/descriptor/body_dynamics.h"

#include <cmath>

#include "multibody/numerics/rotation.h"

namespace flexneck::multibody {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;
using ConstMatrix3Map = Eigen::Map<const Matrix3d>;

}  // namespace

BodyConstants::BodyConstants(const RigidBody& body)
    : mass(body.mass_kg),
      S1(body.mass_kg * body.center_m),
      S2(3, 0),
      J0(body.inertia_kg_m2 - body.mass_kg * skew(body.center_m) * skew(body.center_m)),
      N0(3, 0) {}

BodyConstants::BodyConstants(const DeformableBody& body)
    : slopes(inertia_slopes(body)), springs(body) {
  const fe_modal::InertiaInvariants& from = body.modes.invariants;
  const Index m = body.modes.mode_count();
  mass = from.mass;
  S1 = from.S1;
  S2 = from.S2;
  J0 = from.J0;
  N0 = from.N0;
  Maa = from.Maa;
  G0.resize(9 * m);
  G.resize(9 * m, m);
  N.resize(3 * m, m);
  for (Index l = 0; l < m; ++l) {
    Eigen::Map<Matrix3d>(G0.data() + 9 * l) = from.G0[static_cast<std::size_t>(l)];
    for (Index j = 0; j < m; ++j) {
      const auto jl = static_cast<std::size_t>(j * m + l);
      Eigen::Map<Matrix3d>(&G(9 * l, j)) = from.G[jl] + inertia_curvature(body, j, l);
      N.block<3, 1>(3 * l, j) = from.N[jl];
    }
  }
}

double BodyConstants::radius_m() const { return std::sqrt(J0.trace() / (2 * mass)); }

BodyTerms::BodyTerms(const BodyConstants& body)
    : a(VectorXd::Zero(body.mode_count())),
      S2(body.S2),
      G(9 * body.mode_count()),
      N(3, body.mode_count()),
      mass(Eigen::MatrixXd::Zero(body.velocity_count(), body.velocity_count())),
      u(body.velocity_count()),
      work_modes(3 * body.mode_count()) {
  mass.diagonal().head<3>().setConstant(body.mass);
  mass.bottomRightCorner(body.mode_count(), body.mode_count()) = body.Maa;
}

void update_configuration(const BodyConstants& body, BodyTerms& terms) {
  const Index m = body.mode_count();
  terms.S = body.S1;
  terms.J = body.J0;
  if (m > 0) {
    terms.S.noalias() += body.S2 * terms.a;
    terms.G = body.G0;
    terms.G.noalias() += body.G * terms.a;
    Eigen::Map<VectorXd> columns(terms.N.data(), 3 * m);
    columns = Eigen::Map<const VectorXd>(body.N0.data(), 3 * m);
    columns.noalias() += body.N * terms.a;
    if (body.stiffens()) {
      terms.S += 0.5 * contracted(body.slopes.S2, terms.a, terms.a);
      terms.S2 = body.S2;
      add_slopes(body.slopes.S2, terms.a, terms.S2);
      add_slopes(body.slopes.N, terms.a, terms.N);
    }
    // sum_l a_l (G0_l + G0_l^T) + sum_jl a_j a_l G_jl = sum_l a_l (G0_l^T + G_l(a)).
    for (Index l = 0; l < m; ++l)
      terms.J += terms.a[l] * (ConstMatrix3Map(body.G0.data() + 9 * l).transpose() +
                               ConstMatrix3Map(terms.G.data() + 9 * l));
  }
  Eigen::MatrixXd& M = terms.mass;
  const Matrix3d M_tr = -terms.A * skew(terms.S);
  M.block<3, 3>(0, 3) = M_tr;
  M.block<3, 3>(3, 0) = M_tr.transpose();
  M.block<3, 3>(3, 3) = terms.J;
  for (Index l = 0; l < m; ++l) {
    const Vector3d M_tl = terms.A * terms.S2.col(l);
    M.block<3, 1>(0, 6 + l) = M_tl;
    M.block<1, 3>(6 + l, 0) = M_tl.transpose();
    M.block<3, 1>(3, 6 + l) = terms.N.col(l);
    M.block<1, 3>(6 + l, 3) = terms.N.col(l).transpose();
  }
}

void update_right_hand_side(const BodyConstants& body, const Vector3d& gravity_m_s2,
                            const Eigen::Ref<const VectorXd>& velocity, BodyTerms& terms) {
  const Index m = body.mode_count();
  const Vector3d w = velocity.segment<3>(3);
  const auto adot = velocity.tail(m);
  const Vector3d gravity = terms.A.transpose() * gravity_m_s2;

  // u_t = -A ~w (~w S + 2 S2 adot) + m g,  u_r = -~w J w - 2 sum_l adot_l G_l w + ~S A^T g, plus
  // the terms of section 3a.
  Vector3d moved = w.cross(terms.S);
  Vector3d u_r = terms.S.cross(gravity) - w.cross(terms.J * w);
  if (m > 0) {
    moved.noalias() += 2 * (terms.S2 * adot);
    Matrix3d G_rate = Matrix3d::Zero();
    for (Index l = 0; l < m; ++l) G_rate += adot[l] * ConstMatrix3Map(terms.G.data() + 9 * l);
    u_r -= 2 * (G_rate * w);
    terms.work_modes.noalias() = body.N * adot;
  }
  Vector3d u_t = -w.cross(moved);
  if (body.stiffens()) {
    u_t -= contracted(body.slopes.S2, adot, adot);
    u_r -=
        w.cross(contracted(body.slopes.N, terms.a, adot)) + contracted(body.slopes.N, adot, adot);
  }
  terms.u.head<3>() = body.mass * gravity_m_s2 + terms.A * u_t;
  terms.u.segment<3>(3) = u_r;

  // u_a,l = w^T G_l w - 2 w . sum_j N_jl adot_j - omega^2 a - 2 zeta omega adot + S2_l . A^T g.
  for (Index l = 0; l < m; ++l) {
    const double centrifugal = w.dot(ConstMatrix3Map(terms.G.data() + 9 * l) * w);
    const double coriolis = -2 * w.dot(terms.work_modes.segment<3>(3 * l));
    terms.u[6 + l] = centrifugal + coriolis + terms.S2.col(l).dot(gravity);
    if (!body.stiffens()) terms.u[6 + l] -= body.springs.load(l, terms.a[l], adot[l]);
  }
  if (body.stiffens()) body.springs.add_loads(terms.a, adot, -1, terms.u.tail(m));
  body.springs.add_gap_loads(terms.a, -1, terms.u.tail(m));
}

double kinetic_energy_J(const BodyTerms& terms, const Eigen::Ref<const VectorXd>& velocity) {
  return 0.5 * velocity.dot(terms.mass * velocity);
}

double gravitational_energy_J(const BodyConstants& body, const Vector3d& gravity_m_s2,
                              const BodyTerms& terms) {
  return -body.mass * gravity_m_s2.dot(terms.x) - gravity_m_s2.dot(terms.A * terms.S);
}

}  // namespace flexneck::multibody
