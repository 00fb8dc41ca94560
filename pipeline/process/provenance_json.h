// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "geometry/foundation/provenance.h"

namespace flexneck::pipeline {

/// Program, sources and input files in the form of all JSON files of flexneck; the values are in
/// the HDF5 files.
nlohmann::ordered_json json_of(const Provenance& provenance);

/// Reads a provenance. @throws nlohmann::json::exception if a member is missing or of another type.
Provenance provenance_of_json(const nlohmann::ordered_json& json);

}  // namespace flexneck::pipeline
