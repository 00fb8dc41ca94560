// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/reduction/mode_naming.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <string_view>

#include "fe_modal/body/basis_kind.h"

namespace flexneck::fe_modal {
namespace {

constexpr std::array<std::string_view, 4> kKinds = {"fore-aft bending", "lateral bending",
                                                    "torsion", "axial"};
/// Kind of motion for each of x, y, z, theta_x, theta_y and theta_z.
constexpr std::array<std::size_t, 6> kKindOfMotion = {0, 1, 3, 1, 0, 2};

}  // namespace

Shares motion_shares(const std::vector<RigidAverage>& parts, const Eigen::Matrix3Xd& shape) {
  Shares energies{};
  for (const RigidAverage& part : parts) {
    const Vector6d motion = part.of(shape);
    const Vector6d momentum = part.gram() * motion;
    for (std::size_t i = 0; i < kKindOfMotion.size(); ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      energies[kKindOfMotion[i]] += motion[row] * momentum[row];
    }
  }
  const double sum = std::accumulate(energies.begin(), energies.end(), 0.0);
  if (!(sum > 0)) return {};
  for (double& energy : energies) energy *= 100 / sum;
  return energies;
}

std::vector<std::string> mode_names(const std::vector<Shares>& shares) {
  std::array<int, kKinds.size()> counts{};
  std::vector<std::string> names;
  for (const Shares& share : shares) {
    const auto largest = std::max_element(share.begin(), share.end());
    if (*largest == 0) {
      names.push_back("mode " + std::to_string(names.size() + 1));
      continue;
    }
    const auto kind = static_cast<std::size_t>(largest - share.begin());
    names.push_back(std::string(kKinds[kind]) + " " + std::to_string(++counts[kind]));
  }
  return names;
}

std::vector<std::string> mode_names(const std::vector<Shares>& shares,
                                    const std::vector<std::string>& kinds) {
  std::vector<Shares> modes;
  for (std::size_t k = 0; k < shares.size(); ++k) {
    if (!is_correction(kinds[k])) modes.push_back(shares[k]);
  }
  const std::vector<std::string> names_of_modes = mode_names(modes);
  std::vector<std::string> names;
  std::size_t next = 0;
  std::map<std::string, int> counts;
  for (const std::string& kind : kinds) {
    names.push_back(is_correction(kind) ? kind + " " + std::to_string(++counts[kind])
                                        : names_of_modes[next++]);
  }
  return names;
}

}  // namespace flexneck::fe_modal
