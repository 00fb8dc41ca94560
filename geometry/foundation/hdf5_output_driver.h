// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/foundation/hdf5_handle.h"

namespace flexneck {

class AtomicFile;

/// File access properties with which HDF5 writes into `file`, which must outlive the HDF5 file.
/// HDF5 is never told of a failure, for it then keeps the file open and crashes when the process
/// ends; the AtomicFile remembers it.
Hdf5Handle output_access(AtomicFile& file);

}  // namespace flexneck
