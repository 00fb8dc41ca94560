// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "geometry/foundation/hdf5_file.h"
#include "geometry/foundation/provenance.h"
#include "multibody/analysis/linearisation.h"
#include "multibody/history/history.h"

namespace flexneck::multibody {

/// Format of a history file; the layout is described in pipeline/manual/reference/history_file.md.
inline constexpr FileFormat kHistoryFormat{"flexneck history", 2, "flexneck pendulum"};

/// Curves derived from a history, at its times.
struct Channel {
  std::string name;
  std::string unit;
  std::vector<std::string> columns;  ///< names of the curves, such as x, y, z
  Eigen::MatrixXd values;            ///< one row per curve
  std::string filter;                ///< such as "CFC 600"; empty for none
};

/// Modes of the linearised model, in the group /linearisation. Shapes as in ModeShape, (modes,
/// markers, 3).
struct LinearisationRecord {
  std::string about;                 ///< "equilibrium", "steady rotation" or "given"
  std::vector<std::string> markers;  ///< the model's markers, in its order
  std::vector<ModeShape> modes;
};

struct HistoryFile {
  History history;
  std::vector<Channel> channels = {};
  Provenance provenance;
  std::optional<LinearisationRecord> linearisation = {};
};

/// Writes a history that is whole in memory; HistoryWriter takes it in blocks. `meanwhile` and
/// exceptions are as there.
void write_history(const std::filesystem::path& path, const HistoryFile& file,
                   const std::function<void()>& meanwhile = {});
/// Reads a history.
/// @throws InputError if the file is missing, truncated, foreign or inconsistent.
HistoryFile read_history(const std::filesystem::path& path);

}  // namespace flexneck::multibody
