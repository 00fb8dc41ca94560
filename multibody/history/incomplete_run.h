// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <utility>

#include "geometry/foundation/error.h"
#include "multibody/history/history.h"

namespace flexneck::multibody {

/// A run that could not go on: when and why, and what was computed until then.
class IncompleteRun : public ComputationError {
 public:
  IncompleteRun(const std::string& why, History computed)
      : ComputationError(why), history(std::move(computed)) {}
  History history;  ///< with `incomplete` set
};

}  // namespace flexneck::multibody
