// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "geometry/foundation/hdf5_file.h"
#include "geometry/foundation/provenance.h"
#include "multibody/history.h"

namespace flexneck::multibody {

/// The layout is described in multibody/README.md.
inline constexpr FileFormat kHistoryFormat{"flexneck history", 1, "flexneck pendulum"};

struct HistoryFile {
  History history;
  Provenance provenance;
};

void write_history(const std::filesystem::path& path, const HistoryFile& file);
/// @throws InputError if the file is missing, truncated, foreign or inconsistent.
HistoryFile read_history(const std::filesystem::path& path);

}  // namespace flexneck::multibody
