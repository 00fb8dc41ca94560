// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/analysis/sound_factor.h"

#include "fe_modal/solve/mechanism.h"
#include "geometry/foundation/error.h"

namespace flexneck::fe_modal {

void refuse_mechanism(const std::string& motions) {
  throw InputError("the body is a mechanism: " + motions + "; fix it or bond it to its neighbour");
}

std::unique_ptr<const LinearSolver> factorise_or_refuse(const AssembledSystem& system,
                                                        double shift) {
  try {
    return shift_inverse(system, shift);
  } catch (const NotDefinite&) {
    const auto motions = shift == 0 ? describe_mechanism(system, true) : std::nullopt;
    if (motions) refuse_mechanism(*motions);
    throw;
  }
}

}  // namespace flexneck::fe_modal
