// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/tree/tree_dynamics.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "multibody/cholesky.h"
#include "multibody/rotation.h"

namespace flexneck::multibody::tree {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Z^T I Z with Z = [1, -~r; 0, 1]: an inertia that acts at r, seen from the origin.
[[gnu::always_inline]] inline Matrix6d shifted(const Matrix6d& inertia, const Vector3d& r) {
  const Matrix3d cross = skew(r);
  Matrix6d result;
  const Matrix3d tr = inertia.topRightCorner<3, 3>() - inertia.topLeftCorner<3, 3>() * cross;
  result.topLeftCorner<3, 3>() = inertia.topLeftCorner<3, 3>();
  result.topRightCorner<3, 3>() = tr;
  result.bottomLeftCorner<3, 3>() = tr.transpose();
  result.bottomRightCorner<3, 3>() = inertia.bottomRightCorner<3, 3>() -
                                     inertia.topRightCorner<3, 3>().transpose() * cross +
                                     cross * tr;
  return result;
}

/// Z^T f: a load that acts at r, seen from the origin.
[[gnu::always_inline]] inline Vector6d shifted(const Vector6d& load, const Vector3d& r) {
  Vector6d result = load;
  result.tail<3>() += r.cross(load.head<3>());
  return result;
}

/// Z a: an acceleration of the origin, seen at r.
[[gnu::always_inline]] inline Vector6d carried(const Vector6d& acceleration, const Vector3d& r) {
  Vector6d result = acceleration;
  result.head<3>() += acceleration.tail<3>().cross(r);
  return result;
}

[[gnu::always_inline]] inline Vector6d rotated(const Matrix3d& R, const Vector6d& v) {
  Vector6d result;
  result.head<3>().noalias() = R * v.head<3>();
  result.tail<3>().noalias() = R * v.tail<3>();
  return result;
}

[[gnu::always_inline]] inline Matrix6d rotated(const Matrix3d& R, const Matrix6d& inertia) {
  Matrix6d result;
  const Matrix3d tt = R * inertia.topLeftCorner<3, 3>();
  const Matrix3d tr = R * inertia.topRightCorner<3, 3>();
  const Matrix3d rr = R * inertia.bottomRightCorner<3, 3>();
  result.topLeftCorner<3, 3>().noalias() = tt * R.transpose();
  result.topRightCorner<3, 3>().noalias() = tr * R.transpose();
  result.bottomLeftCorner<3, 3>() = result.topRightCorner<3, 3>().transpose();
  result.bottomRightCorner<3, 3>().noalias() = rr * R.transpose();
  return result;
}

/// What a node's acceleration has besides [acc + wdot x s + psi a''; wdot + jm a''].
[[gnu::always_inline]] inline Vector6d node_bias(const NodeMotion& node, const Vector3d& w) {
  Vector6d bias;
  bias.head<3>() = w.cross(w.cross(node.s) + 2 * node.s_dot);
  bias.tail<3>() = w.cross(node.turn) + node.turn_rate;
  return bias;
}

/// Acceleration of a node of a body.
Vector6d node_acceleration(const TreeNode& node, const NodeMotion& motion,
                           const Vector6d& of_origin, const VectorXd& a_acceleration,
                           const Vector3d& w) {
  Vector6d result = carried(of_origin, motion.s) + node_bias(motion, w);
  if (!node.moves) return result;
  for (Index l = 0; l < a_acceleration.size(); ++l) {
    result.head<3>() += a_acceleration[l] * node.psi.col(l);
    result.tail<3>() += a_acceleration[l] * motion.jm.col(l);
  }
  return result;
}

/// An empty vector for nodes of bodies that do not deform.
const VectorXd& no_modes() {
  static const VectorXd none;
  return none;
}

}  // namespace

TreeDynamics::Work::Work(const TreeBody& body)
    : a(VectorXd::Zero(body.inertia.mode_count())),
      a_rate(a),
      a_acceleration(a),
      inner(body.inner),
      outer(body.outer),
      S(Matrix6d::Zero()),
      terms(body.inertia),
      coupling(6, body.inertia.mode_count()),
      z(a),
      U(Matrix6d::Zero()),
      D(Matrix6d::Zero()),
      reaction(Vector6d::Zero()) {}

TreeDynamics::TreeDynamics(const Tree& tree, Drive drive)
    : tree_(tree),
      drive_(drive),
      gravity_(tree.model.gravity_m_s2),
      interval_begin_s_(-kInfinity),
      interval_end_s_(kInfinity),
      driven_(tree.driven.size()),
      forces_(tree.model),
      extra_forces_(VectorXd::Zero(tree.velocity_count)),
      accelerations_(VectorXd::Zero(tree.velocity_count)) {
  world_.acceleration.head<3>() = -gravity_;
  for (std::size_t d = 0; d < driven_.size(); ++d)
    driven_[d].A = tree.driven[d].start.rotation.toRotationMatrix();
  work_.reserve(tree.bodies.size());
  for (const TreeBody& body : tree.bodies) work_.emplace_back(body);
  for (const TreeMarker& marker : tree.markers) marker_nodes_.emplace_back(marker.node);
}

void TreeDynamics::set_interval(double begin_s, double end_s) {
  interval_begin_s_ = std::nextafter(begin_s, kInfinity);
  interval_end_s_ = std::nextafter(end_s, -kInfinity);
}

double TreeDynamics::table_time(double time_s) const {
  return std::max(interval_begin_s_, std::min(interval_end_s_, time_s));
}

const TreeDynamics::Frame& TreeDynamics::frame_of(const Carrier& carrier) const {
  if (carrier.body != kNone) return work_[carrier.body].frame;
  return carrier.driven != kNone ? driven_[carrier.driven] : world_;
}

void TreeDynamics::update_driven_bodies() {
  for (std::size_t d = 0; d < driven_.size(); ++d) {
    const DrivenPath& path = tree_.driven[d];
    Frame& frame = driven_[d];
    frame.x = path.position_m(time_s_);
    Vector3d acceleration = -gravity_;
    if (drive_ == Drive::prescribed) {
      frame.v = frame.A.transpose() * path.velocity_m_s(time_s_);
      acceleration += path.body.acceleration_m_s2.value(table_time(time_s_)) * path.body.direction;
    }
    frame.acceleration.head<3>() = frame.A.transpose() * acceleration;
  }
}

void TreeDynamics::update_body(const TreeBody& body, Work& work, const ConstVector& state) {
  const Index m = body.inertia.mode_count();
  const Index nq = body.joint.position_count();
  const Index nu = body.joint.velocity_count();
  const auto q = state.segment(body.position, nq);
  const auto u = state.segment(tree_.position_count + body.velocity, nu);
  work.a = state.segment(body.position + nq, m);
  work.a_rate = state.segment(tree_.position_count + body.velocity + nu, m);
  const Frame& carrier = frame_of(body.carrier);
  if (body.carrier.body != kNone) {
    const Work& inner = work_[body.carrier.body];
    tree::update(body.inner, inner.a, inner.a_rate, work.inner);
  }
  tree::update(body.outer, work.a, work.a_rate, work.outer);
  tree::update(body.joint, q, u, work.joint);

  // Orientation and place.
  const JointMotion& joint = work.joint;
  work.R.noalias() = (work.inner.R * joint.R) * work.outer.R.transpose();
  work.d.noalias() = work.inner.R * joint.d;
  Frame& frame = work.frame;
  frame.A.noalias() = carrier.A * work.R;
  frame.x = carrier.x + carrier.A * (work.inner.s + work.d) - frame.A * work.outer.s;

  // Velocities of F in the carrier's axes, of M and of the body in the body's.
  const Vector3d w_F = carrier.w + work.inner.turn;
  const Vector3d v_F = carrier.v + carrier.w.cross(work.inner.s) + work.inner.s_dot;
  Vector6d relative = Vector6d::Zero();
  for (Index k = 0; k < nu; ++k) {
    work.S.block<3, 1>(0, k).noalias() = work.outer.R * joint.S.block<3, 1>(0, k);
    work.S.block<3, 1>(3, k).noalias() = work.outer.R * joint.S.block<3, 1>(3, k);
    relative += u[k] * work.S.col(k);
  }
  const Vector3d w_carried = work.R.transpose() * w_F;
  const Vector3d w_M = w_carried + relative.tail<3>();
  const Vector3d v_M = work.R.transpose() * (v_F + w_F.cross(work.d)) + relative.head<3>();
  frame.w = w_M - work.outer.turn;
  frame.v = v_M - frame.w.cross(work.outer.s) - work.outer.s_dot;

  work.inner_bias = node_bias(work.inner, carrier.w);
  work.outer_bias = node_bias(work.outer, frame.w);
  work.joint_bias.head<3>() =
      work.R.transpose() * w_F.cross(w_F.cross(work.d)) + 2 * w_carried.cross(relative.head<3>());
  work.joint_bias.tail<3>() = w_carried.cross(relative.tail<3>()) + work.outer.R * joint.S_dot_u;
  tree::update(body.inertia, work.a, work.a_rate, frame.w, work.terms);
}

void TreeDynamics::update(double time_s, const ConstVector& state) {
  time_s_ = time_s;
  update_driven_bodies();
  for (std::size_t b = 0; b < work_.size(); ++b) update_body(tree_.bodies[b], work_[b], state);
  apply_forces();
}

void TreeDynamics::apply_forces() {
  const std::vector<std::size_t>& touched = forces_.markers();
  for (std::size_t k = 0; k < touched.size(); ++k) {
    const TreeMarker& marker = tree_.markers[touched[k]];
    NodeMotion& node = marker_nodes_[touched[k]];
    if (marker.carrier.body != kNone) {
      const Work& work = work_[marker.carrier.body];
      tree::update(marker.node, work.a, work.a_rate, node);
    }
    const Frame& frame = frame_of(marker.carrier);
    ForceMarker& slot = forces_.slot(k);
    slot.p = frame.x + frame.A * node.s;
    slot.v = frame.A * (frame.v + frame.w.cross(node.s) + node.s_dot);
    slot.R = frame.A * node.R;
    slot.w = frame.A * (frame.w + node.turn);
  }
  forces_.evaluate(table_time(time_s_));
  for (std::size_t k = 0; k < touched.size(); ++k)
    apply(tree_.markers[touched[k]], marker_nodes_[touched[k]], forces_.slot(k).force_N,
          forces_.slot(k).moment_Nm);
}

void TreeDynamics::apply(const TreeMarker& marker, const NodeMotion& node, const Vector3d& force,
                         const Vector3d& torque) {
  if (marker.carrier.body == kNone) return;
  Work& work = work_[marker.carrier.body];
  const Vector3d f = work.frame.A.transpose() * force;
  const Vector3d t = work.frame.A.transpose() * torque;
  work.terms.bias_r.head<3>() -= f;
  work.terms.bias_r.tail<3>() -= node.s.cross(f) + t;
  if (!marker.node.moves) return;
  for (Index l = 0; l < work.a.size(); ++l)
    work.terms.bias_a[l] -= marker.node.psi.col(l).dot(f) + node.jm.col(l).dot(t);
}

void TreeDynamics::eliminate_modes(const TreeBody& body, Work& work) {
  // In terms of M's acceleration: [acc; wdot] = X (a_M - outer_bias - Phi a''), X = [1, ~s; 0, 1].
  const Index m = body.inertia.mode_count();
  const Vector3d back = -work.outer.s;
  const bool shifts = !body.outer.at_origin;
  InertiaTerms& terms = work.terms;
  work.inertia = shifts ? shifted(terms.M_rr, back) : terms.M_rr;
  work.bias = shifts ? shifted(terms.bias_r, back) : terms.bias_r;
  // Where M is the origin, the bias of its acceleration is zero.
  if (shifts) work.bias.noalias() -= work.inertia * work.outer_bias;
  if (m == 0) return;
  Matrix6Xd& coupling = work.coupling;
  for (Index l = 0; l < m; ++l) {
    coupling.col(l) = terms.M_ra.col(l);
    if (shifts) coupling.col(l) = shifted(Vector6d(coupling.col(l)), back);
    // The body's own modal forces and those of the extra kind.
    work.z[l] = terms.bias_a[l] - coupling.col(l).dot(work.outer_bias) -
                extra_forces_[body.velocity + body.joint.velocity_count() + l];
  }
  if (body.outer.moves) {
    for (Index l = 0; l < m; ++l) {
      Vector6d shape;
      shape << body.outer.psi.col(l), work.outer.jm.col(l);
      work.z[l] -= shape.dot(work.bias);
      // M_aa <- M_aa - Phi^T X^T M_ra - (its transpose) + Phi^T X^T M_rr X Phi.
      const Vector6d loaded = work.inertia * shape;
      for (Index k = 0; k < m; ++k) {
        Vector6d other;
        other << body.outer.psi.col(k), work.outer.jm.col(k);
        terms.M_aa(k, l) +=
            other.dot(loaded) - other.dot(coupling.col(l)) - coupling.col(k).dot(shape);
      }
    }
    for (Index l = 0; l < m; ++l) {
      Vector6d shape;
      shape << body.outer.psi.col(l), work.outer.jm.col(l);
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
    work.inertia.noalias() -= coupling.col(k) * coupling.col(k).transpose();
    work.bias -= work.z[k] * coupling.col(k);
  }
}

void TreeDynamics::eliminate_joint(const TreeBody& body, Work& work) {
  const Index nu = body.joint.velocity_count();
  if (nu == 0) return;
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
    work.inertia.noalias() -= work.U.col(k) * work.U.col(k).transpose();
    work.bias += work.residual[k] * work.U.col(k);
  }
}

void TreeDynamics::pass_inwards(const TreeBody& body, Work& work) {
  if (body.carrier.body == kNone) return;
  Work& carrier = work_[body.carrier.body];
  Vector6d load = work.bias;
  load.noalias() += work.inertia * work.joint_bias;
  Matrix6d inertia = rotated(work.R, work.inertia);
  load = rotated(work.R, load);
  if (body.joint.kind == TreeJoint::Kind::slider ||
      body.joint.kind == TreeJoint::Kind::cylindrical) {
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
    shape << body.inner.psi.col(l), work.inner.jm.col(l);
    const Vector6d loaded = inertia * shape;
    terms.M_ra.col(l) += shifted(loaded, work.inner.s);
    terms.bias_a[l] += shape.dot(load);
    for (Index k = l; k < m; ++k)
      terms.M_aa(k, l) +=
          body.inner.psi.col(k).dot(loaded.head<3>()) + work.inner.jm.col(k).dot(loaded.tail<3>());
  }
}

void TreeDynamics::accelerate(const TreeBody& body, Work& work) {
  const Index m = body.inertia.mode_count();
  const Index nu = body.joint.velocity_count();
  const Frame& carrier = frame_of(body.carrier);
  const bool deforms = body.carrier.body != kNone;
  const Vector6d at_F =
      node_acceleration(body.inner, work.inner, carrier.acceleration,
                        deforms ? work_[body.carrier.body].a_acceleration : no_modes(), carrier.w);
  Vector6d at_M = rotated(work.R.transpose(), carried(at_F, work.d)) + work.joint_bias;
  work.reaction = work.bias;
  work.reaction.noalias() += work.inertia * at_M;

  // Joint: u' = L^-T (residual - U^T a), with U and residual scaled by L^-1 already.
  auto u_rate = accelerations_.segment(body.velocity, nu);
  for (Index k = nu; k-- > 0;) {
    double value = work.residual[k] - work.U.col(k).dot(at_M);
    for (Index l = k + 1; l < nu; ++l) value -= work.D(l, k) * u_rate[l];
    u_rate[k] = value * work.D(k, k);
  }
  for (Index k = 0; k < nu; ++k) at_M += u_rate[k] * work.S.col(k);

  // Modes: a'' = -L^-T (Y a_M + z).
  for (Index k = m; k-- > 0;) {
    double value = -(work.coupling.col(k).dot(at_M) + work.z[k]);
    for (Index l = k + 1; l < m; ++l) value -= work.terms.M_aa(l, k) * work.a_acceleration[l];
    work.a_acceleration[k] = value * work.terms.M_aa(k, k);
  }
  accelerations_.segment(body.velocity + nu, m) = work.a_acceleration;

  Vector6d at_origin = at_M - work.outer_bias;
  if (body.outer.moves)
    for (Index l = 0; l < m; ++l) {
      at_origin.head<3>() -= work.a_acceleration[l] * body.outer.psi.col(l);
      at_origin.tail<3>() -= work.a_acceleration[l] * work.outer.jm.col(l);
    }
  work.frame.acceleration = carried(at_origin, -work.outer.s);
}

void TreeDynamics::solve() {
  for (std::size_t b = work_.size(); b-- > 0;) {
    const TreeBody& body = tree_.bodies[b];
    eliminate_modes(body, work_[b]);
    eliminate_joint(body, work_[b]);
    pass_inwards(body, work_[b]);
  }
  for (std::size_t b = 0; b < work_.size(); ++b) accelerate(tree_.bodies[b], work_[b]);
  ++evaluations_;
}

void TreeDynamics::evaluate(double time_s, const ConstVector& state, VectorXd& rate) {
  update(time_s, state);
  solve();
  const Index nq = tree_.position_count;
  const Index nv = tree_.velocity_count;
  for (const TreeBody& body : tree_.bodies) {
    const Index q = body.joint.position_count();
    const Index u = body.joint.velocity_count();
    const Index m = body.inertia.mode_count();
    position_rate(body.joint, state.segment(body.position, q), state.segment(nq + body.velocity, u),
                  rate.segment(body.position, q));
    rate.segment(body.position + q, m) = state.segment(nq + body.velocity + u, m);
  }
  rate.segment(nq, nv) = accelerations_;
  rate[nq + nv] = dissipation_W();
  rate[nq + nv + 1] = work_W();
}

}  // namespace flexneck::multibody::tree
