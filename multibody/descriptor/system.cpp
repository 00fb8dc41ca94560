// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/descriptor/system.h"

#include <algorithm>
#include <cmath>

#include "multibody/descriptor/massless_rotation.h"
#include "multibody/numerics/rotation.h"

namespace flexneck::multibody {
namespace {

using Eigen::Index;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr std::size_t kNone = JointPlace::kNoBody;

/// Visitor that returns a rigid or deformable body's constants; a prescribed one has none.
struct ConstantsOf {
  std::vector<BodyConstants> operator()(const RigidBody& body) const {
    return {BodyConstants(body)};
  }
  std::vector<BodyConstants> operator()(const DeformableBody& body) const {
    return {BodyConstants(body)};
  }
  std::vector<BodyConstants> operator()(const PrescribedBody&) const { return {}; }
};

}  // namespace

System::System(const Model& of)
    : model(of),
      joints(of.joints),
      gravity_m_s2(of.gravity_m_s2),
      internal_count(multibody::internal_count(of.forces)),
      internal_blocks(multibody::internal_blocks(of.forces)) {
  std::vector<std::size_t> free_index(model.bodies.size(), kNone);
  std::vector<std::size_t> prescribed_index(model.bodies.size(), kNone);
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const Body& body = model.bodies[b];
    if (const auto* prescribed_body = std::get_if<PrescribedBody>(&body.kind)) {
      prescribed_index[b] = prescribed.size();
      prescribed.emplace_back(body.initial_pose, *prescribed_body);
      continue;
    }
    const BodyConstants constants = std::visit(ConstantsOf{}, body.kind).front();
    free_index[b] = bodies.size();
    bodies.push_back({body.name, b, constants, position_count, velocity_count});
    position_count += constants.velocity_count() + 1;
    velocity_count += constants.velocity_count();
    size_m = std::max(size_m, constants.radius_m());
  }
  for (const Marker& marker : model.markers) {
    markers.push_back({NodeConstants(model.bodies[marker.body], marker), free_index[marker.body],
                       prescribed_index[marker.body]});
  }
  for (const Joint& joint : joints) {
    for (const std::size_t marker : {joint.marker_i, joint.marker_j})
      if (markers[marker].free_body != kNone)
        size_m = std::max(size_m, markers[marker].node.s0.norm());
    places.push_back({markers[joint.marker_i].free_body, markers[joint.marker_j].free_body,
                      JointRows(joint, 0, 0).rows});
    constraint_count += places.back().rows;
  }
  if (size_m == 0) size_m = 1;
  for (FreeBody& body : bodies)
    if (const auto* rigid = std::get_if<RigidBody>(&model.bodies[body.index].kind)) {
      RigidBody raised = *rigid;
      raised.inertia_kg_m2 = raised_inertia(model, body.index, size_m);
      body.constants = BodyConstants(raised);
    }
}

std::vector<Index> System::body_sizes() const {
  std::vector<Index> sizes;
  for (const FreeBody& body : bodies) sizes.push_back(body.constants.velocity_count());
  return sizes;
}

VectorXd System::velocity_lengths_m() const {
  VectorXd lengths = VectorXd::Ones(velocity_count);
  for (const FreeBody& body : bodies) {
    lengths.segment<3>(body.velocity + 3).setConstant(size_m);
    lengths.segment(body.velocity + 6, body.constants.mode_count())
        .setConstant(1 / std::sqrt(body.constants.mass));
  }
  return lengths;
}

void System::retract(Eigen::Ref<VectorXd> positions,
                     const Eigen::Ref<const VectorXd>& change) const {
  for (const FreeBody& body : bodies) {
    const Index m = body.constants.mode_count();
    auto Q = positions.segment(body.position, 7 + m);
    const auto dQ = change.segment(body.velocity, 6 + m);
    Q.head<3>() += dQ.head<3>();
    const Eigen::Quaterniond q(Q[3], Q[4], Q[5], Q[6]);
    const Eigen::Quaterniond turned = (q * quaternion_exp(dQ.segment<3>(3))).normalized();
    Q[3] = turned.w();
    Q.segment<3>(4) = turned.vec();
    Q.tail(m) += dQ.tail(m);
  }
}

void System::normalise(Eigen::Ref<VectorXd> positions) const {
  for (const FreeBody& body : bodies) positions.segment<4>(body.position + 3).normalize();
}

}  // namespace flexneck::multibody
