// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "geometry/foundation/hdf5_file.h"
#include "multibody/files/history_file.h"

namespace flexneck::multibody {

/// Writes a history block by block while outputs are computed, so that memory need not hold all of
/// it. Without finish() nothing is left.
class HistoryWriter {
 public:
  /// @throws InputError if the folder cannot be written.
  explicit HistoryWriter(std::filesystem::path path);

  /// Appends the next outputs, with the same markers, joints, bodies and channels as before.
  void append(const History& outputs, const std::vector<Channel>& channels);
  /// Appends the last outputs, of which there may be none, and the data known at the end of the
  /// run: statistics, warnings, linearisation, provenance.
  /// @param meanwhile called while the disk takes the file, which then gets its name
  /// @throws InputError if a name cannot be that of a group.
  void finish(const HistoryFile& last, const std::function<void()>& meanwhile = {});

 private:
  Hdf5Writer file_;
};

}  // namespace flexneck::multibody
