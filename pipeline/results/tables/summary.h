// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "multibody/files/history_file.h"

namespace flexneck::pipeline {

/// Text with the cost of a run and the accuracy of its constraints.
std::string run_summary(const multibody::History& history);

/// Text with frequencies and damping of the linearised model, and each mode's marker of largest
/// motion.
std::string mode_summary(const multibody::LinearisationRecord& linearisation);

/// Minimum and maximum of every curve with their times, gathered block by block.
class PeakTable {
 public:
  /// Takes subsequent values of the same channels.
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
