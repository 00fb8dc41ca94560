// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/history/deformation_guard.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "geometry/foundation/error.h"
#include "geometry/foundation/output_file.h"

namespace flexneck::multibody {
namespace {

using Eigen::Vector3d;

struct Limits {
  double told, stopped;
};
constexpr Limits kRotation_rad = {1, 2 * std::numbers::pi};
constexpr Limits kDisplacement = {0.5, 5};  ///< in lengths of the body

/// Length of a body: the diagonal of the bounding box of nodes and interfaces, or its radius of
/// inertia if it has no extent.
double length_of(const fe_modal::ModalBody& body) {
  Vector3d lowest =
      body.interfaces.empty() ? Vector3d::Zero().eval() : body.interfaces.front().position_m;
  Vector3d highest = lowest;
  const auto add = [&](const Vector3d& point) {
    lowest = lowest.cwiseMin(point);
    highest = highest.cwiseMax(point);
  };
  for (const fe_modal::Interface& each : body.interfaces) add(each.position_m);
  for (Eigen::Index k = 0; k < body.nodes_m.cols(); ++k) add(body.nodes_m.col(k));
  const double length = (highest - lowest).norm();
  const fe_modal::InertiaInvariants& inertia = body.invariants;
  return length > 0 ? length : std::sqrt(inertia.J0.trace() / (2 * inertia.mass));
}

}  // namespace

DeformationGuard::DeformationGuard(const Model& model) {
  for (const Body& body : model.bodies) {
    const auto* deformable = std::get_if<DeformableBody>(&body.kind);
    bodies_.emplace_back();
    safe_.push_back(std::numeric_limits<double>::infinity());
    if (deformable == nullptr || deformable->modes.mode_count() == 0) continue;
    Watched watched{deformable, body.name, length_of(deformable->modes),
                    deformable->modes.invariants.mass};
    double largest = 1 / (std::sqrt(watched.mass_kg) * watched.length_m * kDisplacement.told);
    for (const fe_modal::Interface& each : deformable->modes.interfaces)
      largest = std::max({largest, each.rotation.norm() / kRotation_rad.told,
                          each.translation.norm() / (watched.length_m * kDisplacement.told)});
    safe_.back() = 1 / (largest * largest);
    bodies_.back() = watched;
  }
}

std::string DeformationGuard::text_of(const Deformation& found) {
  const std::string where =
      found.interface == nullptr ? "its mass" : "interface '" + found.interface->name + "'";
  return std::string(found.turns ? "rotates " : "displaces ") + where + " by " +
         (found.turns ? rounded_text(found.value * 180 / std::numbers::pi, 3) + " deg"
                      : rounded_text(found.value, 3) + " of its length") +
         " at " + rounded_text(found.time_s, 4) + " s";
}

void DeformationGuard::check_large(double time_s, std::size_t body, const ConstVector& a) {
  Watched& watched = bodies_[body].value();
  Deformation worst;
  bool is_beyond = false;
  const auto consider = [&](double value, bool turns, const fe_modal::Interface* interface) {
    const Limits& limits = turns ? kRotation_rad : kDisplacement;
    is_beyond |= !(value <= limits.stopped);
    // NaN is worse than any number.
    if (!(value / limits.told <= worst.of_limit))
      worst = {value / limits.told, value, turns, interface, time_s};
  };
  consider(a.norm() / (std::sqrt(watched.mass_kg) * watched.length_m), false, nullptr);
  for (const fe_modal::Interface& each : watched.body->modes.interfaces) {
    consider((each.rotation * a).norm(), true, &each);
    consider((each.translation * a).norm() / watched.length_m, false, &each);
  }
  if (worst.of_limit > 1 && watched.largest.of_limit <= 1) watched.since_s = time_s;
  if (worst.of_limit > watched.largest.of_limit) watched.largest = worst;
  if (is_beyond)
    throw ComputationError("body '" + watched.name + "' " + text_of(worst) +
                           ", where a modal description is meaningless; its loads are too large, "
                           "or it needs stress_stiffening or a division into several bodies");
}

std::vector<std::string> DeformationGuard::warnings() const {
  std::vector<std::string> texts;
  for (const std::optional<Watched>& each : bodies_)
    if (each && each->largest.of_limit > 1)
      texts.push_back("body '" + each->name + "' leaves the small deformations of its modes at " +
                      rounded_text(each->since_s, 3) + " s and at worst " + text_of(each->largest) +
                      "; errors exceed 10 %; divide it into several bodies");
  return texts;
}

}  // namespace flexneck::multibody
