// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/analysis/sound_factor.h"

#include "fe_modal/element/rounding.h"
#include "fe_modal/solve/mechanism.h"
#include "geometry/foundation/error.h"

namespace flexneck::fe_modal {

namespace {

void refuse_named_motions(const AssembledSystem& system, bool is_fixed) {
  if (const auto motions = describe_mechanism(system, is_fixed))
    throw InputError("the body is a mechanism: " + *motions +
                     "; fix it, or connect it to its neighbour");
}

}  // namespace

void refuse_mechanism(const AssembledSystem& system, bool is_fixed) {
  refuse_named_motions(system, is_fixed);
  throw ComputationError(
      "the body is a mechanism, or so close to one that rounding errors exceed the strain energy "
      "of its softest motion: " +
      cause_of_rounding(system.model().mesh()));
}

std::unique_ptr<const LinearSolver> factorise_or_refuse(const AssembledSystem& system,
                                                        double shift) {
  try {
    return shift_inverse(system, shift);
  } catch (const NotDefinite&) {
    if (shift == 0) refuse_named_motions(system, true);
    throw;
  }
}

}  // namespace flexneck::fe_modal
