// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "multibody/files/history_file.h"

namespace flexneck::pipeline {

/// What a run took and how well its constraints held, for reading.
std::string run_summary(const multibody::History& history);

/// Frequencies and damping of the linearised model, and which marker of each mode moves most.
std::string mode_summary(const multibody::LinearisationRecord& linearisation);

/// The smallest and the largest value of every curve with their times, gathered block by block.
class PeakTable {
 public:
  /// Values that follow those before, of the same channels.
  void append(const Eigen::VectorXd& time_s, const std::vector<multibody::Channel>& channels);
  std::string text() const;

 private:
  struct Curve {
    std::string channel, column, unit, filter;
    double smallest, smallest_s, largest, largest_s;
  };
  std::vector<Curve> curves_;
};

}  // namespace flexneck::pipeline
