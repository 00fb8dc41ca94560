// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/joint_check.h"

#include <algorithm>
#include <sstream>

#include "geometry/foundation/error.h"

namespace flexneck::multibody {
namespace {

constexpr double kTolerance = 1e-6;
/// A system without extent, such as a point on a ball joint.
constexpr double kSmallestSize_m = 1e-3;

[[noreturn]] void refuse(const Joint& joint, const Model& model, const std::string& problem) {
  throw InputError("joint '" + joint.name + "' between markers '" +
                   model.markers[joint.marker_i].name + "' and '" +
                   model.markers[joint.marker_j].name + "': " + problem);
}

}  // namespace

void check_positions(const Model& model, std::size_t joint, const Violation& found, double size_m) {
  const double size = std::max(size_m, kSmallestSize_m);
  if (found.translation <= kTolerance * size && found.rotation <= kTolerance) return;
  std::ostringstream problem;
  problem << "at the start the markers are " << found.translation << " m and " << found.rotation
          << " rad apart; give the bodies poses that fit the joint";
  refuse(model.joints[joint], model, problem.str());
}

void check_velocities(const Model& model, std::size_t joint, const Violation& found, double size_m,
                      double speed_m_s) {
  const double size = std::max(size_m, kSmallestSize_m);
  if (found.translation <= kTolerance * speed_m_s &&
      size * found.rotation <= kTolerance * speed_m_s)
    return;
  std::ostringstream problem;
  problem << "at the start the markers part with " << found.translation << " m/s and "
          << found.rotation << " rad/s; give the bodies velocities that fit the joint";
  refuse(model.joints[joint], model, problem.str());
}

void refuse_floating_body(const std::string& body) {
  throw InputError("body '" + body +
                   "': no joint connects it, directly or through others, to a driven body, so "
                   "it has no equilibrium");
}

}  // namespace flexneck::multibody
