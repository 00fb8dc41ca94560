// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/analysis/sound_factor.h"

#include "fe_modal/solve/mechanism.h"
#include "geometry/foundation/available_memory.h"
#include "geometry/foundation/error.h"

namespace flexneck::fe_modal {

void refuse_mechanism(const std::string& motions) {
  throw InputError("the body is a mechanism: " + motions + "; fix it or bond it to its neighbour");
}

std::unique_ptr<const ShiftInverse> factorise_or_refuse(const mesher::Mesh& mesh,
                                                        const AssembledSystem& system,
                                                        double shift) {
  const auto refuse_if_mechanism = [&] {
    const auto motions = shift == 0 ? describe_mechanism(mesh, system, true) : std::nullopt;
    if (motions) refuse_mechanism(*motions);
  };
  try {
    std::unique_ptr<const ShiftInverse> inverse = system.shift_inverse(shift);
    if (inverse->is_doubtful()) refuse_if_mechanism();
    return inverse;
  } catch (const OutOfMemory&) {
    throw;
  } catch (const ComputationError&) {
    refuse_if_mechanism();
    throw;
  }
}

}  // namespace flexneck::fe_modal
