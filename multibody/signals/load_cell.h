// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "multibody/history/history.h"

namespace flexneck::multibody {

/// Rows Fx, Fy, Fz in N and Mx, My, Mz in N m, one column per output time.
using LoadCellChannels = Eigen::Matrix<double, 6, Eigen::Dynamic>;

/// Signals of a neck load cell in the joint with the signs of SAE J211, about the joint point.
/// Marker i must be on the lower body with x forward and z towards the head; a load cell's axes are
/// those of SAE (x forward, y right, z down), so each channel is the component in these axes of the
/// load of the lower body on the upper one.
///
/// Positive signs, as J211 defines them by movements of the head with the chest fixed: Fx head
/// rearward, Fy head leftward, Fz head upward, Mx left ear toward left shoulder, My chin toward
/// sternum, Mz chin toward left shoulder.
LoadCellChannels sae_j211(const JointHistory& joint);

}  // namespace flexneck::multibody
