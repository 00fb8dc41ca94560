// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "geometry/foundation/hdf5_handle.h"

namespace flexneck::fuzz {

/// Opens a file in memory.
/// @throws ComputationError if the image is no HDF5 file.
Hdf5Handle opened_image(const std::string& image);
std::string image_of(const Hdf5Handle& file);
/// The content of a file without its hash block.
std::string without_hash(const std::string& sound);

Hdf5Handle opened_object(hid_t file, const std::string& path);
std::vector<std::string> attributes_of(hid_t object);
void copy_attributes(hid_t from, hid_t to);

}  // namespace flexneck::fuzz
