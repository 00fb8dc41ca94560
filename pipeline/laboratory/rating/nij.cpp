// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/laboratory/rating/nij.h"

#include <vector>

#include "geometry/foundation/error.h"
#include "geometry/foundation/names.h"
#include "multibody/signals/cfc_filter.h"

namespace flexneck::pipeline {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

struct Combination {
  std::string_view name, text;
  int force_sign, moment_sign;
};

constexpr std::array<Combination, 4> kCombinations = {{
    {"NTE", "tension, extension", 1, -1},
    {"NTF", "tension, flexion", 1, 1},
    {"NCE", "compression, extension", -1, -1},
    {"NCF", "compression, flexion", -1, 1},
}};

}  // namespace

const NeckIntercepts& neck_intercepts(const std::string& dummy) {
  std::vector<std::string> names;
  names.reserve(kNeckIntercepts.size());
  for (const NeckIntercepts& each : kNeckIntercepts) names.emplace_back(each.name);
  return kNeckIntercepts.at(find_name(names, dummy, "dummy"));
}

VectorXd condyle_moment(const VectorXd& force_x_N, const VectorXd& moment_y_Nm, double arm_m) {
  if (force_x_N.size() != moment_y_Nm.size())
    throw InputError("expected as many values of the force as of the moment");
  return moment_y_Nm - arm_m * force_x_N;
}

std::array<NijPeak, 4> nij(const CondyleLoads& loads, const NeckIntercepts& intercepts) {
  if (loads.force_z_N.size() != loads.moment_y_Nm.size())
    throw InputError("expected as many values of the force as of the moment");
  const auto filtered = [&](const VectorXd& load) -> VectorXd {
    if (loads.is_filtered) return load;
    return multibody::cfc_filtered(load, loads.interval_s, multibody::ChannelClass::cfc600);
  };
  const VectorXd force = filtered(loads.force_z_N);
  const VectorXd moment = filtered(loads.moment_y_Nm);
  std::array<NijPeak, 4> peaks;
  for (std::size_t c = 0; c < peaks.size(); ++c) {
    const Combination& combination = kCombinations.at(c);
    NijPeak& peak = peaks.at(c);
    peak.name = combination.name;
    peak.combination = combination.text;
    const double force_intercept =
        combination.force_sign > 0 ? intercepts.tension_N : intercepts.compression_N;
    const double moment_intercept =
        combination.moment_sign > 0 ? intercepts.flexion_Nm : intercepts.extension_Nm;
    for (Index k = 0; k < force.size(); ++k) {
      const double force_share = combination.force_sign * force[k] / force_intercept;
      const double moment_share = combination.moment_sign * moment[k] / moment_intercept;
      if (force_share < 0 || moment_share < 0 || !(force_share + moment_share > peak.value))
        continue;
      peak.value = force_share + moment_share;
      peak.sample = k;
      peak.force_N = force[k];
      peak.moment_Nm = moment[k];
    }
  }
  return peaks;
}

}  // namespace flexneck::pipeline
