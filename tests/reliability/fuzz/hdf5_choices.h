// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "geometry/foundation/hdf5_handle.h"
#include "tests/reliability/fuzz/edit_script.h"

namespace flexneck::fuzz {

using Extents = std::vector<hsize_t>;

Extents extents_of(const Hdf5Handle& space);
hsize_t count_of(const Extents& extents);
Hdf5Handle space_of(const Extents& extents);

/// A random type of any class, most often numbers.
Hdf5Handle any_type(EditScript& script);
/// A random storage layout of a dataset: contiguous, in chunks with filters, within its header,
/// external.
Hdf5Handle any_layout(EditScript& script, const Extents& extents);
/// Returns whether data can be written: HDF5 1.10 crashes in some of its own filters; readers
/// refuse them unread.
bool can_be_written(const Hdf5Handle& creation);

}  // namespace flexneck::fuzz
