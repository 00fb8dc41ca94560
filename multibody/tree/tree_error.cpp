// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/tree/tree_error.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "multibody/equations/internal_error.h"

namespace flexneck::multibody::tree {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr std::size_t kParts = 4;
constexpr std::array<const char*, kParts> kNames = {"position", "rate", "deformation",
                                                    "rate of deformation"};

}  // namespace

TreeError::TreeError(const Tree& tree, double relative, double absolute)
    : tree_(tree), tolerance_{relative, absolute} {}

double TreeError::fastest_joint(const VectorXd& state) const {
  double squared = 0;
  const double size = tree_.size_m * tree_.size_m;
  for (const TreeBody& body : tree_.bodies) {
    const Index n = body.joint.law->distances;
    const Index nu = body.joint.velocity_count();
    const Index first = tree_.position_count + body.velocity;
    squared = std::max({squared, state.segment(first, n).squaredNorm(),
                        size * state.segment(first + n, nu - n).squaredNorm()});
  }
  return std::sqrt(squared);
}

ErrorEstimate TreeError::operator()(const VectorXd& begin, const VectorXd& end,
                                    const VectorXd& error) const {
  ErrorEstimate worst;
  const auto consider = [&](std::size_t component, double size, double reference) {
    worst.consider(component, tolerance_.ratio(size, reference));
  };
  const double speed = std::max(fastest_joint(begin), fastest_joint(end));
  for (std::size_t b = 0; b < tree_.bodies.size(); ++b) {
    const TreeBody& body = tree_.bodies[b];
    const Index n = body.joint.law->distances;
    const Index nq = body.joint.position_count();
    const Index nu = body.joint.velocity_count();
    const Index m = body.inertia.mode_count();
    const Index q = body.position;
    const Index u = tree_.position_count + body.velocity;
    const std::size_t first = b * kParts;
    // A quaternion changes by half the angle.
    const double turn = body.joint.law->has_quaternion ? 2 : 1;
    if (n > 0) {
      consider(first, error.segment(q, n).norm(), tree_.size_m);
      consider(first + 1, error.segment(u, n).norm(), speed);
    }
    if (nu > n) {
      consider(first, turn * error.segment(q + n, nq - n).norm(), 1);
      consider(first + 1, tree_.size_m * error.segment(u + n, nu - n).norm(), speed);
    }
    if (m == 0) continue;
    const ModalAmplitude present(body.inertia.springs.stiffness, end.segment(q + nq, m),
                                 end.segment(u + nu, m));
    const double scale = 1 / std::sqrt(body.inertia.mass);
    consider(first + 2, scale * error.segment(q + nq, m).norm(), scale * present.displacement);
    consider(first + 3, scale * error.segment(u + nu, m).norm(), scale * present.velocity);
  }
  consider_internal(tree_.internal(error), tree_.internal_blocks, tree_.size_m, tolerance_,
                    tree_.bodies.size() * kParts, worst);
  return worst;
}

std::string TreeError::name_of(std::size_t component) const {
  if (tree_.bodies.empty()) return "work (no body is free)";
  const std::size_t of_bodies = tree_.bodies.size() * kParts;
  if (component >= of_bodies) return name_of_branch(tree_.model.forces, component - of_bodies);
  const TreeBody& body = tree_.bodies[component / kParts];
  const std::size_t part = component % kParts;
  const bool of_joint = part < 2 && body.joint_index != kNone;
  const std::string& name = of_joint ? tree_.model.joints[body.joint_index].name : body.name;
  return std::string(kNames[part]) + (of_joint ? " of joint '" : " of body '") + name + "'";
}

}  // namespace flexneck::multibody::tree
