// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/time/time_integrator.h"

#include <cmath>
#include <sstream>

#include "geometry/foundation/error.h"

namespace flexneck::multibody {

void TimeIntegrator::collapse(const ErrorEstimate& error) const {
  std::ostringstream message;
  message.precision(9);
  message << "the step size fell below " << limits_.smallest_s << " s at " << time_s_
          << " s; what limits it is the " << name_of(error.component);
  if (!std::isfinite(error.value)) message << ", which is not a number";
  throw ComputationError(message.str());
}

}  // namespace flexneck::multibody
