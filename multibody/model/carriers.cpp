// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/model/carriers.h"

#include <string>
#include <variant>

#include "geometry/foundation/error.h"
#include "multibody/model/joint_check.h"
#include "multibody/model/prescribed_path.h"

namespace flexneck::multibody {
namespace {

using Eigen::Vector3d;
using Velocities = std::vector<std::optional<Vector3d>>;

/// Two bodies, one of which carries the other.
struct Connection {
  std::size_t body_i, body_j;
  std::string title;
};

std::vector<Connection> connections(const Model& model) {
  std::vector<Connection> found;
  const auto add = [&](std::size_t marker_i, std::size_t marker_j, std::string title) {
    found.push_back({model.markers[marker_i].body, model.markers[marker_j].body, std::move(title)});
  };
  for (const Joint& joint : model.joints)
    if (!joint.kind->holds_nothing())
      add(joint.marker_i, joint.marker_j, "joint '" + joint.name + "'");
  model.forces.each_kind([&]<class Kind>(const std::vector<Kind>& elements) {
    if constexpr (HoldingForce<Kind>)
      for (const Kind& element : elements) add(element.marker_i, element.marker_j, title(element));
  });
  return found;
}

bool is_prescribed(const Body& body) { return std::holds_alternative<PrescribedBody>(body.kind); }

void carry(const Model& model, const Connection& by, std::size_t from, std::size_t to,
           Velocities& velocities) {
  if (is_prescribed(model.bodies[to]) || !velocities[from]) return;
  std::optional<Vector3d>& carried = velocities[to];
  if (carried && (*carried - *velocities[from]).norm() > 0)
    throw InputError(by.title + ": body '" + model.bodies[to].name +
                     "' is connected to prescribed bodies with different initial velocities; a "
                     "start from equilibrium needs a common velocity");
  carried = velocities[from];
}

}  // namespace

Velocities carrier_velocities(const Model& model) {
  Velocities velocities(model.bodies.size());
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    if (const auto* prescribed = std::get_if<PrescribedBody>(&model.bodies[b].kind))
      velocities[b] = PrescribedPath(model.bodies[b].initial_pose, *prescribed).at(0).velocity_m_s;
  const std::vector<Connection> all = connections(model);
  // There are as many passes as the longest chain has bodies.
  for (std::size_t pass = 0; pass <= model.bodies.size(); ++pass)
    for (const Connection& each : all) {
      carry(model, each, each.body_i, each.body_j, velocities);
      carry(model, each, each.body_j, each.body_i, velocities);
    }
  return velocities;
}

void check_no_body_floats(const Model& model) {
  const Velocities velocities = carrier_velocities(model);
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    if (!velocities[b]) refuse_floating_body(model.bodies[b].name);
}

}  // namespace flexneck::multibody
