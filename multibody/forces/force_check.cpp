// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/forces/force_check.h"

#include <cmath>

#include "geometry/foundation/error.h"
#include "geometry/foundation/output_file.h"
#include "geometry/foundation/symmetric_pairs.h"

namespace flexneck::multibody {

void refuse_force(const std::string& who, const std::string& problem) {
  throw InputError(who + ": " + problem);
}

void check_marker(const std::string& who, std::size_t marker, const ForceSites& sites) {
  const std::size_t count = sites.marker_bodies.size();
  if (marker < count) return;
  refuse_force(who, "there is no marker of index " + std::to_string(marker) + ": there are " +
                        std::to_string(count));
}

void check_pair(const std::string& who, std::size_t marker_i, std::size_t marker_j,
                const ForceSites& sites) {
  check_marker(who, marker_i, sites);
  check_marker(who, marker_j, sites);
  const std::string& body = sites.marker_bodies[marker_i];
  if (body == sites.marker_bodies[marker_j])
    refuse_force(who, "both markers are on body '" + body + "'; it needs two bodies");
}

void check_direction(const std::string& who, const Eigen::Vector3d& direction) {
  constexpr double kSlack = 1e-9;
  if (std::abs(direction.norm() - 1) <= kSlack) return;
  refuse_force(
      who, "direction must be a unit vector, but its length is " + exact_text(direction.norm()));
}

void check_stiffness(const std::string& who, const std::string& what,
                     const Eigen::Ref<const Eigen::MatrixXd>& matrix) {
  constexpr double kSlack = 1e-9;
  if (!matrix.allFinite()) refuse_force(who, what + " is not finite");
  const double size = matrix.cwiseAbs().maxCoeff();
  if ((matrix - matrix.transpose()).cwiseAbs().maxCoeff() > kSlack * size)
    refuse_force(who, what + " must be symmetric");
  const double lowest = symmetric_eigenvalues(matrix)[0];
  if (lowest < -kSlack * size)
    refuse_force(who, what + " must not have a negative eigenvalue, but has " + exact_text(lowest));
}

void check_not_negative(const std::string& who, const std::string& what, double value) {
  if (!(value >= 0 && std::isfinite(value)))
    refuse_force(who, what + " must not be negative, but is " + exact_text(value));
}

}  // namespace flexneck::multibody
