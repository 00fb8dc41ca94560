// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include <Eigen/Core>

#include "multibody/history/history.h"

namespace flexneck::multibody {

struct OutputOptions {
  double end_time_s = 1.0;
  double interval_s = 1e-3;
  /// If given, it takes the outputs in blocks while the run computes them, so that memory does not
  /// grow with their number. The run then returns the last block only.
  std::function<void(const History& outputs)> sink = {};
  Eigen::Index block = 0;   ///< outputs of a block, with a sink
  bool states = false;      ///< true to record History::state
  double begin_time_s = 0;  ///< time of the model's start
};

}  // namespace flexneck::multibody
