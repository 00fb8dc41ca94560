// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "geometry/foundation/hdf5_file.h"
#include "multibody/files/history_file.h"

namespace flexneck::multibody {

/// Writes a history as its outputs come, block by block, so that memory need not hold it whole.
/// Without finish() nothing is left.
class HistoryWriter {
 public:
  /// @throws InputError if the folder cannot be written.
  explicit HistoryWriter(std::filesystem::path path);

  /// Outputs that follow those before: of the same markers, joints, bodies and channels.
  void append(const History& outputs, const std::vector<Channel>& channels);
  /// The last outputs, which may be none, with what is known at the end of the run: statistics,
  /// warnings, linearisation, provenance.
  /// @param meanwhile work that is done while the disk takes the file, which then gets its name
  /// @throws InputError if a name cannot be that of a group.
  void finish(const HistoryFile& last, const std::function<void()>& meanwhile = {});

 private:
  Hdf5Writer file_;
};

}  // namespace flexneck::multibody
