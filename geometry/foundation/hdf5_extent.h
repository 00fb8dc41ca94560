// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "geometry/foundation/hdf5_handle.h"

namespace flexneck {

/// Reason to refuse a dataset: its data are in another file, compressed by a filter other than
/// gzip, shuffle and fletcher32, were never written, or are more than the file can hold. Empty text
/// if there is none; no value if HDF5 cannot tell.
/// @param file_size in bytes
std::optional<std::string> extent_problem(const Hdf5Handle& dataset, std::uintmax_t file_size);

}  // namespace flexneck
