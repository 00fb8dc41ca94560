// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/tree/tree.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "geometry/foundation/error.h"

namespace flexneck::multibody::tree {
namespace {

using Eigen::Index;

bool is_prescribed(const Body& body) { return std::holds_alternative<PrescribedBody>(body.kind); }

bool turns(const PrescribedTurn& turn) {
  return turn.initial_rate_rad_s != 0 || !turn.acceleration_rad_s2.times_s().empty() ||
         !turn.motion.is_none();
}

/// A body in the order of a traversal of the joints from the prescribed bodies outwards, then of
/// the remaining bodies, each time from the first of them.
struct Visit {
  std::size_t body;
  std::size_t carrier;  ///< index among the model's bodies; kNone for the world
  std::size_t joint;
};

struct Walk {
  std::vector<Visit> order;
  std::optional<std::size_t> closing_joint;
  std::optional<std::size_t> unsuited_joint;  ///< a joint whose kind or motors do not fit a tree
};

Walk walk(const Model& model) {
  Walk found;
  std::vector<std::vector<std::size_t>> joints_on(model.bodies.size());
  for (std::size_t k = 0; k < model.joints.size(); ++k) {
    const Joint& joint = model.joints[k];
    if (joint.kind->holds_nothing()) continue;
    if (joint.kind->motion == nullptr || !joint.motors.empty()) found.unsuited_joint = k;
    for (const std::size_t marker : {model.joints[k].marker_i, model.joints[k].marker_j})
      joints_on[model.markers[marker].body].push_back(k);
  }
  std::vector<bool> reached(model.bodies.size(), false);
  std::vector<bool> used(model.joints.size(), false);
  std::vector<std::size_t> queue;
  const auto spread = [&] {
    for (std::size_t next = 0; next < queue.size(); ++next)
      for (const std::size_t k : joints_on[queue[next]]) {
        if (used[k]) continue;
        used[k] = true;
        const std::size_t body_i = model.markers[model.joints[k].marker_i].body;
        const std::size_t body_j = model.markers[model.joints[k].marker_j].body;
        const std::size_t other = body_i == queue[next] ? body_j : body_i;
        if (reached[other]) {
          if (!found.closing_joint) found.closing_joint = k;
          continue;
        }
        reached[other] = true;
        queue.push_back(other);
        found.order.push_back({other, queue[next], k});
      }
    queue.clear();
  };
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    if (!is_prescribed(model.bodies[b])) continue;
    reached[b] = true;
    queue.push_back(b);
  }
  spread();
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    if (reached[b]) continue;
    reached[b] = true;
    queue.push_back(b);
    found.order.push_back({b, kNone, kNone});
    spread();
  }
  return found;
}

struct InertiaOf {
  std::optional<BodyInertia> operator()(const RigidBody& body) const { return BodyInertia(body); }
  std::optional<BodyInertia> operator()(const DeformableBody& body) const {
    return BodyInertia(body);
  }
  std::optional<BodyInertia> operator()(const PrescribedBody&) const { return std::nullopt; }
};

double trace(const Vector6d& packed) { return packed[0] + packed[1] + packed[2]; }

}  // namespace

double joint_angle_rad(const Tree& tree, std::size_t joint,
                       const Eigen::Ref<const Eigen::VectorXd>& state) {
  // The angle is the last coordinate in all kinds that have one.
  const TreeBody& body = tree.bodies[tree.body_of_joint[joint]];
  const double angle = state[body.position + body.joint.position_count() - 1];
  return body.inner_is_i ? angle : -angle;
}

void retract(const Tree& tree, const Eigen::Ref<const Eigen::VectorXd>& change,
             Eigen::Ref<Eigen::VectorXd> positions) {
  for (const TreeBody& body : tree.bodies) {
    const Index nq = body.joint.position_count();
    const Index nu = body.joint.velocity_count();
    const Index m = body.inertia.mode_count();
    retract(body.joint, change.segment(body.velocity, nu), positions.segment(body.position, nq));
    positions.segment(body.position + nq, m) += change.segment(body.velocity + nu, m);
  }
}

bool is_tree(const Model& model) {
  const Walk walked = walk(model);
  return !walked.closing_joint && !walked.unsuited_joint;
}

Tree::Tree(const Model& of)
    : model(of),
      body_of_joint(of.joints.size(), kNone),
      internal_count(multibody::internal_count(of.forces)),
      internal_blocks(multibody::internal_blocks(of.forces)) {
  const Walk walked = walk(model);
  if (walked.unsuited_joint) {
    const Joint& joint = model.joints[*walked.unsuited_joint];
    throw InputError(
        "joint '" + joint.name + "' " +
        (joint.motors.empty() ? "is of the kind " + std::string(joint.kind->name)
                              : "has the motor '" + joint.motors[0].name + "'") +
        ", which the recursive formulation does not support; use the descriptor formulation");
  }
  if (walked.closing_joint)
    throw InputError("joint '" + model.joints[*walked.closing_joint].name +
                     "' closes a loop of joints, which the recursive formulation does not support; "
                     "use the descriptor formulation");
  std::vector<Carrier> carriers(model.bodies.size());
  std::vector<bool> turning;  // flag of each prescribed body
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const auto* body = std::get_if<PrescribedBody>(&model.bodies[b].kind);
    if (body == nullptr) continue;
    carriers[b].prescribed = prescribed.size();
    prescribed.emplace_back(model.bodies[b].initial_pose, *body);
    turning.push_back(turns(body->turn));
  }
  bodies.reserve(walked.order.size());
  for (const Visit& visit : walked.order) {
    const Body& body = model.bodies[visit.body];
    TreeBody added{body.name,
                   visit.body,
                   *std::visit(InertiaOf{}, body.kind),
                   {},
                   visit.joint,
                   true,
                   {},
                   {},
                   {},
                   position_count,
                   velocity_count};
    if (visit.joint != kNone) {
      const Joint& joint = model.joints[visit.joint];
      added.carrier = carriers[visit.carrier];
      added.inner_is_i = model.markers[joint.marker_i].body == visit.carrier;
      added.joint = TreeJoint(joint, added.inner_is_i);
      const Marker& marker_i = model.markers[joint.marker_i];
      const Marker& marker_j = model.markers[joint.marker_j];
      added.inner = {model.bodies[visit.carrier], added.inner_is_i ? marker_i : marker_j};
      added.outer = {body, added.inner_is_i ? marker_j : marker_i};
      body_of_joint[visit.joint] = bodies.size();
      size_m = std::max(size_m, added.outer.s0.norm());
      if (added.carrier.body != kNone) size_m = std::max(size_m, added.inner.s0.norm());
    } else {
      const Index m = added.inertia.mode_count();
      added.outer.psi.setZero(3, m);
      added.outer.mu.setZero(3, m);
    }
    const Index m = added.inertia.mode_count();
    position_count += added.joint.position_count() + m;
    velocity_count += added.joint.velocity_count() + m;
    size_m = std::max(size_m, std::sqrt(trace(added.inertia.J0) / (2 * added.inertia.mass)));
    carriers[visit.body].body = bodies.size();
    bodies.push_back(std::move(added));
  }
  if (size_m == 0) size_m = 1;
  std::vector<bool> carries(bodies.size(), false);
  for (const TreeBody& body : bodies)
    if (body.carrier.body != kNone) carries[body.carrier.body] = true;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    TreeBody& body = bodies[b];
    const bool is_rigid_outside = body.inertia.mode_count() == 0 && !carries[b];
    body.is_rigid_end = body.is_fixed() && is_rigid_outside;
    body.is_alone = body.joint_index == kNone && is_rigid_outside;
    body.rides = body.is_fixed() && body.inertia.mode_count() > 0 && !body.inertia.stiffens() &&
                 !body.outer.moves && body.carrier.prescribed != kNone &&
                 !turning[body.carrier.prescribed];
  }
  for (const Marker& marker : model.markers)
    markers.push_back({TreeNode(model.bodies[marker.body], marker), carriers[marker.body]});
}

}  // namespace flexneck::multibody::tree
