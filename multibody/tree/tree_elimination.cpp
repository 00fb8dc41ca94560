// SPDX-License-Identifier: GPL-3.0-or-later
// Inward pass of the recursion: modes and joints are eliminated body by body.
#include <cmath>

#include "multibody/numerics/cholesky.h"
#include "multibody/tree/spatial.h"
#include "multibody/tree/tree_dynamics.h"

namespace flexneck::multibody::tree {

using Eigen::Index;
using Eigen::Vector3d;

void TreeDynamics::eliminate_modes(const TreeBody& body, Work& work) {
  // In terms of M's acceleration: [acc; wdot] = X (a_M - outer_bias - Phi a''), X = [1, ~s; 0, 1].
  const Index m = body.inertia.mode_count();
  const Vector3d back = -work.outer.s;
  const bool shifts = !body.outer.at_origin;
  InertiaTerms& terms = work.terms;
  if (!body.is_rigid_end) work.inertia = shifts ? shifted(terms.M_rr, back) : terms.M_rr;
  work.bias = shifts ? shifted(terms.bias_r, back) : terms.bias_r;
  // If M is the origin, the bias of its acceleration is zero.
  if (shifts) work.bias.noalias() -= work.inertia * work.outer_bias;
  if (m == 0) return;
  // The articulated inertia of a body fixed to a prescribed one is not needed.
  const bool is_held = body.carrier.body == kNone && body.is_fixed();
  Matrix6Xd& coupling = work.coupling;
  for (Index l = 0; l < m; ++l) {
    coupling.col(l) = terms.M_ra.col(l);
    if (shifts) coupling.col(l) = shifted(Vector6d(coupling.col(l)), back);
    // Modal forces of the body and the extra ones.
    work.z[l] = terms.bias_a[l] - coupling.col(l).dot(work.outer_bias) -
                extra_forces_[body.velocity + body.joint.velocity_count() + l];
  }
  if (body.outer.moves) {
    for (Index l = 0; l < m; ++l) {
      Vector6d shape;
      shape << work.outer.psi.col(l), work.outer.jm.col(l);
      work.z[l] -= shape.dot(work.bias);
      // M_aa <- M_aa - Phi^T X^T M_ra - (its transpose) + Phi^T X^T M_rr X Phi.
      const Vector6d loaded = work.inertia * shape;
      for (Index k = 0; k < m; ++k) {
        Vector6d other;
        other << work.outer.psi.col(k), work.outer.jm.col(k);
        terms.M_aa(k, l) +=
            other.dot(loaded) - other.dot(coupling.col(l)) - coupling.col(k).dot(shape);
      }
    }
    for (Index l = 0; l < m; ++l) {
      Vector6d shape;
      shape << work.outer.psi.col(l), work.outer.jm.col(l);
      coupling.col(l).noalias() -= work.inertia * shape;
    }
  }
  // M_aa = L L^T; Y = L^-1 M_ra^T, kept as its transpose.
  factorise_cholesky(terms.M_aa);
  for (Index k = 0; k < m; ++k) {
    coupling.col(k) *= terms.M_aa(k, k);
    work.z[k] *= terms.M_aa(k, k);
    for (Index l = k + 1; l < m; ++l) {
      coupling.col(l) -= terms.M_aa(l, k) * coupling.col(k);
      work.z[l] -= terms.M_aa(l, k) * work.z[k];
    }
    if (is_held) continue;
    work.inertia.noalias() -= coupling.col(k) * coupling.col(k).transpose();
    work.bias -= work.z[k] * coupling.col(k);
  }
}

void TreeDynamics::eliminate_joint(const TreeBody& body, Work& work) {
  const Index nu = body.joint.velocity_count();
  if (nu == 0) return;
  const bool is_carried = body.carrier.body != kNone;  // otherwise nothing is passed inwards
  for (Index k = 0; k < nu; ++k) {
    work.U.col(k).noalias() = work.inertia * work.S.col(k);
    work.residual[k] = extra_forces_[body.velocity + k] - work.S.col(k).dot(work.bias);
  }
  for (Index k = 0; k < nu; ++k)
    for (Index l = 0; l <= k; ++l) work.D(k, l) = work.S.col(k).dot(work.U.col(l));
  // L of S^T U = L L^T, inverse on its diagonal; U <- U L^-T, residual <- L^-1 residual.
  for (Index k = 0; k < nu; ++k) {
    const double scale = 1 / std::sqrt(work.D(k, k));
    work.D(k, k) = scale;
    work.U.col(k) *= scale;
    work.residual[k] *= scale;
    for (Index l = k + 1; l < nu; ++l) work.D(l, k) *= scale;
    for (Index l = k + 1; l < nu; ++l) {
      work.U.col(l) -= work.D(l, k) * work.U.col(k);
      work.residual[l] -= work.D(l, k) * work.residual[k];
      for (Index j = k + 1; j <= l; ++j) work.D(l, j) -= work.D(l, k) * work.D(j, k);
    }
    if (!is_carried) continue;
    work.inertia.noalias() -= work.U.col(k) * work.U.col(k).transpose();
    work.bias += work.residual[k] * work.U.col(k);
  }
}

void TreeDynamics::pass_inwards(const TreeBody& body, Work& work) {
  if (body.carrier.body == kNone) return;
  if (body.is_rigid_end) {
    pass_inwards_from_rigid_end(body, work);
    return;
  }
  Work& carrier = work_[body.carrier.body];
  Vector6d load = work.bias;
  load.noalias() += work.inertia * work.joint_bias;
  Matrix6d inertia = rotated(work.R, work.inertia);
  load = rotated(work.R, load);
  if (body.joint.law->translates) {
    inertia = shifted(inertia, work.d);
    load = shifted(load, work.d);
  }
  load.noalias() += inertia * work.inner_bias;
  InertiaTerms& terms = carrier.terms;
  terms.M_rr += shifted(inertia, work.inner.s);
  terms.bias_r += shifted(load, work.inner.s);
  if (!body.inner.moves) return;
  const Index m = carrier.a.size();
  for (Index l = 0; l < m; ++l) {
    Vector6d shape;
    shape << work.inner.psi.col(l), work.inner.jm.col(l);
    const Vector6d loaded = inertia * shape;
    terms.M_ra.col(l) += shifted(loaded, work.inner.s);
    terms.bias_a[l] += shape.dot(load);
    for (Index k = l; k < m; ++k)
      terms.M_aa(k, l) +=
          work.inner.psi.col(k).dot(loaded.head<3>()) + work.inner.jm.col(k).dot(loaded.tail<3>());
  }
}

/// Passes inwards an inertia [m, -~S; ~S, J]: only S and J must be rotated and shifted.
void TreeDynamics::pass_inwards_from_rigid_end(const TreeBody& body, Work& work) {
  Work& carrier = work_[body.carrier.body];
  const Vector3d& s = work.inner.s;
  const double mass = body.inertia.mass;
  const Vector3d S = work.R * Vector3d(work.inertia(1, 5), work.inertia(2, 3), work.inertia(0, 4));
  const Eigen::Matrix3d J = work.R * work.inertia.bottomRightCorner<3, 3>() * work.R.transpose();
  const auto loaded = [&](const Vector3d& along, const Vector3d& about) {
    Vector6d load;
    load.head<3>() = mass * along - S.cross(about);
    load.tail<3>() = S.cross(along) + J * about;
    return load;
  };
  const Vector6d load =
      rotated(work.R, work.bias) + loaded(work.inner_bias.head<3>(), work.inner_bias.tail<3>());
  InertiaTerms& terms = carrier.terms;
  const Eigen::Matrix3d crossed = skew(Vector3d(S + mass * s));
  const Eigen::Matrix3d sS = s * (S + 0.5 * mass * s).transpose();
  terms.M_rr.topLeftCorner<3, 3>().diagonal().array() += mass;
  terms.M_rr.topRightCorner<3, 3>() -= crossed;
  terms.M_rr.bottomLeftCorner<3, 3>() += crossed;
  terms.M_rr.bottomRightCorner<3, 3>() += J - sS - sS.transpose();
  terms.M_rr.bottomRightCorner<3, 3>().diagonal().array() += 2 * sS.trace();
  terms.bias_r += shifted(load, s);
  if (!body.inner.moves) return;
  const Index m = carrier.a.size();
  for (Index l = 0; l < m; ++l) {
    const Vector3d psi = work.inner.psi.col(l);
    const Vector3d jm = work.inner.jm.col(l);
    const Vector6d at_node = loaded(psi, jm);
    terms.M_ra.col(l) += shifted(at_node, s);
    terms.bias_a[l] += psi.dot(load.head<3>()) + jm.dot(load.tail<3>());
    for (Index k = l; k < m; ++k)
      terms.M_aa(k, l) += work.inner.psi.col(k).dot(at_node.head<3>()) +
                          work.inner.jm.col(k).dot(at_node.tail<3>());
  }
}

}  // namespace flexneck::multibody::tree
