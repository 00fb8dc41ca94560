// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

#include <Eigen/Core>

#include "tests/campaigns/campaign.h"

namespace flexneck::campaigns {

/// A random number with uniform logarithm.
inline double log_between(Case& drawn, double low, double high) {
  return std::exp(drawn.between(std::log(low), std::log(high)));
}

/// A random unit vector, uniform over the sphere.
inline Eigen::Vector3d direction(Case& drawn) {
  Eigen::Vector3d v;
  do {
    v = {drawn.between(-1, 1), drawn.between(-1, 1), drawn.between(-1, 1)};
  } while (v.norm() > 1 || v.norm() < 0.1);
  return v.normalized();
}

}  // namespace flexneck::campaigns
