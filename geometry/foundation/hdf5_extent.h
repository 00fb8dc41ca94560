// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "geometry/foundation/hdf5_handle.h"

namespace flexneck {

/// Why a dataset is not read: its data are elsewhere, compressed by a filter other than gzip,
/// shuffle and fletcher32, were never written, or are more than the file can hold. An empty text if
/// it is read, none if HDF5 cannot tell.
/// @param file_size in bytes
std::optional<std::string> extent_problem(const Hdf5Handle& dataset, std::uintmax_t file_size);

}  // namespace flexneck
