// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <utility>

#include "geometry/foundation/error.h"
#include "multibody/history/history.h"

namespace flexneck::multibody {

/// Thrown if a run cannot go on, with the time, the reason and the results until then.
class IncompleteRun : public ComputationError {
 public:
  IncompleteRun(const std::string& why, History computed)
      : ComputationError(why), history(std::move(computed)) {}
  History history;  ///< with `incomplete` set
};

}  // namespace flexneck::multibody
