// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <deque>
#include <future>
#include <map>
#include <string>
#include <vector>

#include "fe_modal/body/modal_body_file.h"
#include "pipeline/cli/commands.h"
#include "pipeline/experiments/pendulum.h"

namespace flexneck::pipeline {

/// The study's cases of the pendulum, including variants, in its order.
std::vector<const CaseSection*> pendulum_cases(const Study& study);

struct NeckModes {
  fe_modal::ModalBody body;
  std::vector<InputFile> files;
  Study study;  ///< with its submeshes attached in the cases that have them as sections
};

/// Reads the modes of the neck.
/// @throws InputError if they are missing or were made with other values than the study has now.
NeckModes read_neck_modes(const CommandInput& input);

/// Results keyed by the name of the case.
using PendulumResults = std::map<std::string, PendulumResult>;

/// Writes the tables of all cases of the pendulum.
/// @param known results of cases that this process has just run; the others are read from the
/// cases' files, whose hash takes time
/// @throws InputError if such a file is missing, stems from other values or is incomplete.
void write_pendulum_tables(const CommandInput& input, const PendulumResults& known);

/// Runs cases of the pendulum: all processors compute ahead, files are written in order.
class PendulumCases {
 public:
  PendulumCases(const CommandInput& input, std::vector<const CaseSection*> cases);
  /// Waits for the next case and writes its files. @throws std::logic_error if there is none,
  /// ComputationError if the run has ended early, with what there is of it in the files.
  void write_next();
  /// Results of the cases that have been written.
  const PendulumResults& results() const { return results_; }

 private:
  void compute_ahead();
  void write(const CaseSection& experiment, PendulumRun&& run);

  const CommandInput& input_;
  NeckModes modes_;
  std::vector<const CaseSection*> cases_;  ///< pointers into modes_.study
  std::size_t written_ = 0;
  PendulumResults results_;
  /// Runs being computed. Declared last: its tasks end before the data that they read.
  std::deque<std::future<PendulumRun>> running_;
};

}  // namespace flexneck::pipeline
