// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "multibody/files/history_writer.h"
#include "pipeline/model/model_file.h"
#include "pipeline/output/csv_output.h"
#include "pipeline/output/summary.h"

namespace flexneck::pipeline {

/// Writes what a model's run leaves as it comes: the history and the channels as HDF5, the channels
/// as a table. Blocks of outputs go to the files and are forgotten; where a channel is filtered,
/// the channels are kept to the end, for the filter runs over all times in both directions.
class SimulatedOutput {
 public:
  /// @param history, table  the files; without any, empty, what finish() returns is all there is
  /// @param outputs how many there will be
  /// @throws InputError if the folder cannot be written.
  SimulatedOutput(const ModelFile& model, std::filesystem::path history,
                  const std::filesystem::path& table, Eigen::Index outputs);

  /// Outputs that follow those before.
  /// @throws InputError at the first if the disk, or memory for filtered channels, will not take
  /// all of them.
  void append(const multibody::History& outputs);

  /// The last outputs, with what belongs to the run as a whole; the files take their places.
  /// @return what the file says of the run
  multibody::HistoryFile finish(const multibody::History& last,
                                std::optional<multibody::LinearisationRecord> linearisation);

  const PeakTable& peaks() const { return peaks_; }

 private:
  struct Block {
    multibody::History history;  ///< of the markers and joints that are written
    std::vector<multibody::Channel> channels;
  };

  /// With the channels not filtered yet.
  Block derived(const multibody::History& outputs);
  void require_room(const Block& first) const;
  void keep(const Block& block);
  /// The channels of all outputs, filtered.
  std::vector<multibody::Channel> take_kept();
  void show(const Eigen::VectorXd& time_s, const std::vector<multibody::Channel>& channels);

  const ModelFile& model_;
  std::filesystem::path path_;
  Eigen::Index outputs_;
  std::optional<multibody::HistoryWriter> history_;
  std::optional<CsvWriter> table_;
  PeakTable peaks_;
  std::vector<ChannelSpec> specs_;  ///< of the channels, once the first block has come
  bool has_filters_ = false;
  std::vector<Eigen::VectorXd> last_;  ///< values of each channel, which the next ones follow
  Eigen::VectorXd kept_time_s_;
  std::vector<multibody::Channel> kept_;
};

}  // namespace flexneck::pipeline
