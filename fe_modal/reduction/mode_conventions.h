// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "fe_modal/solve/eigensolver.h"
#include "fe_modal/system/field_map.h"
#include "fe_modal/system/rigid_average.h"

namespace flexneck::fe_modal {

/// Makes modes unique. Frequencies closer than 1e-6 relative share their space: within it the basis
/// is turned so that the motion seen is fore-aft (x with theta_y) as far as possible for the first
/// mode, lateral (y with theta_x) for the last. Then the largest of the motion's three translations
/// and length x three rotations is made positive.
/// @param pairs changed in place; rigid-body modes (frequency zero) keep their basis
/// @param seen where the motion is observed
/// @param length_m turns rotations into lengths
void apply_conventions(EigenPairs& pairs, const FieldMap& field_map, const RigidAverage& seen,
                       double length_m);

/// Where nothing is observed: the largest component is made positive.
void apply_conventions(EigenPairs& pairs, const DofLayout& layout);

}  // namespace flexneck::fe_modal
