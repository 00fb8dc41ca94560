// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "fe_modal/solve/eigensolver.h"
#include "fe_modal/system/field_map.h"
#include "fe_modal/system/rigid_average.h"

namespace flexneck::fe_modal {

/// Makes modes unique. Frequencies closer than 1e-6 relative have a common eigenspace: its basis is
/// rotated so that the observed motion is fore-aft (x with theta_y) as far as possible for the
/// first mode, lateral (y with theta_x) for the last. Then the largest of the motion's three
/// translations and length x three rotations is made positive.
/// @param pairs changed in place; rigid-body modes (frequency zero) keep their basis
/// @param seen region where the motion is observed
/// @param length_m scales rotations to lengths
void apply_conventions(EigenPairs& pairs, const FieldMap& field_map, const RigidAverage& seen,
                       double length_m);

/// Makes the largest component of each mode positive, if no region is observed.
void apply_conventions(EigenPairs& pairs, const DofLayout& layout);

}  // namespace flexneck::fe_modal
