// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/descriptor/coupled_bodies.h"

#include <set>

namespace flexneck::multibody {

std::vector<Equations::VelocityBlock> coupled_bodies(const System& system, const ForceSet& forces) {
  std::vector<std::vector<std::size_t>> ties = forces.markers_of_elements();
  for (const Joint& joint : system.joints) ties.push_back({joint.marker_i, joint.marker_j});
  std::vector<std::set<std::size_t>> coupled(system.bodies.size());
  for (std::size_t b = 0; b < coupled.size(); ++b) coupled[b].insert(b);
  for (const std::vector<std::size_t>& markers : ties)
    for (const std::size_t one : markers)
      for (const std::size_t other : markers) {
        const std::size_t body = system.markers[one].free_body;
        const std::size_t tied = system.markers[other].free_body;
        if (body != JointPlace::kNoBody && tied != JointPlace::kNoBody) coupled[body].insert(tied);
      }
  std::vector<Equations::VelocityBlock> blocks;
  for (std::size_t b = 0; b < coupled.size(); ++b)
    blocks.push_back({system.bodies[b].velocity,
                      system.bodies[b].constants.velocity_count(),
                      {coupled[b].begin(), coupled[b].end()}});
  return blocks;
}

}  // namespace flexneck::multibody
