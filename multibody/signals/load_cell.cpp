// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/signals/load_cell.h"

namespace flexneck::multibody {

LoadCellChannels sae_j211(const JointHistory& joint) {
  // A rotation by half a turn about x maps the model's axes to those of SAE.
  const Eigen::Vector3d to_sae(1, -1, -1);
  LoadCellChannels channels(6, joint.force_N.cols());
  channels.topRows<3>() = to_sae.asDiagonal() * joint.force_N;
  channels.bottomRows<3>() = to_sae.asDiagonal() * joint.moment_Nm;
  return channels;
}

}  // namespace flexneck::multibody
