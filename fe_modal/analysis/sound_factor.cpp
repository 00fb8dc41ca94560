// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/analysis/sound_factor.h"

#include "fe_modal/solve/mechanism.h"
#include "geometry/foundation/error.h"

namespace flexneck::fe_modal {

void refuse_mechanism(const std::string& motions) {
  throw InputError("the body is a mechanism: " + motions + "; fix it or bond it to its neighbour");
}

std::unique_ptr<const ShiftInverse> factorise_or_refuse(const mesher::Mesh& mesh,
                                                        const AssembledSystem& system,
                                                        double shift) {
  try {
    return system.shift_inverse(shift);
  } catch (const ComputationError&) {
    const auto motions = shift == 0 ? describe_mechanism(mesh, system, true) : std::nullopt;
    if (!motions) throw;
    refuse_mechanism(*motions);
  }
}

}  // namespace flexneck::fe_modal
