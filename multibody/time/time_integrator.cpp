// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/time/time_integrator.h"

#include <cmath>

#include "geometry/foundation/error.h"
#include "geometry/foundation/output_file.h"

namespace flexneck::multibody {

void TimeIntegrator::collapse(const ErrorEstimate& error) const {
  constexpr int kDigits = 9;
  throw ComputationError("the step size fell below " + rounded_text(limits_.smallest_s, kDigits) +
                         " s at " + rounded_text(time_s_, kDigits) + " s; it is limited by the " +
                         name_of(error.component) +
                         (std::isfinite(error.value) ? "" : ", which is not a finite number"));
}

}  // namespace flexneck::multibody
