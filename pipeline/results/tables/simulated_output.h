// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "multibody/files/history_writer.h"
#include "pipeline/language/model/model_file.h"
#include "pipeline/results/tables/csv_output.h"
#include "pipeline/results/tables/summary.h"

namespace flexneck::pipeline {

/// Writes the output of a model's run as it is computed: the history and the channels as HDF5, the
/// channels as a table. Blocks of outputs are written and released; if a channel is filtered, all
/// channels are kept to the end, since the filter runs over all times in both directions.
class SimulatedOutput {
 public:
  /// @param history, table  the files; if empty, nothing is written and finish() returns all
  /// results
  /// @param outputs total number of outputs
  /// @throws InputError if the folder cannot be written.
  SimulatedOutput(const ModelFile& model, std::filesystem::path history,
                  const std::filesystem::path& table, Eigen::Index outputs);

  /// Appends outputs.
  /// @throws InputError at the first block if the disk, or memory for filtered channels, cannot
  /// take all outputs.
  void append(const multibody::History& outputs);

  /// Completes the output with the last block and the data of the whole run; the files are put in
  /// place.
  /// @return the content of the file
  multibody::HistoryFile finish(const multibody::History& last,
                                std::optional<multibody::LinearisationRecord> linearisation);

  const PeakTable& peaks() const { return peaks_; }

 private:
  struct Block {
    multibody::History history;  ///< history of the markers and joints that are written
    std::vector<multibody::Channel> channels;
  };

  /// Block with the channels not filtered yet.
  Block derived(const multibody::History& outputs);
  void require_room(const Block& first) const;
  void keep(const Block& block);
  /// Returns the channels of all outputs, filtered.
  std::vector<multibody::Channel> take_kept();
  void show(const Eigen::VectorXd& time_s, const std::vector<multibody::Channel>& channels);

  const ModelFile& model_;
  std::filesystem::path path_;
  Eigen::Index outputs_;
  std::optional<multibody::HistoryWriter> history_;
  std::optional<CsvWriter> table_;
  PeakTable peaks_;
  /// Specifications of the channels, once the first block is known.
  std::vector<ChannelSpec> specs_;
  bool has_filters_ = false;
  /// Last values of each channel, with which the next ones are made continuous.
  std::vector<Eigen::VectorXd> last_;
  Eigen::VectorXd kept_time_s_;
  std::vector<multibody::Channel> kept_;
};

}  // namespace flexneck::pipeline
