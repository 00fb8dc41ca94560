// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include "fe_modal/algebra/ranks.h"
#include "pipeline/language/study/study.h"
#include "pipeline/process/console.h"
#include "pipeline/run/results_folder.h"

namespace flexneck::pipeline {

/// Distribution of the work; empty and 0 where the user sets nothing.
struct WorkShares {
  std::string shard;  ///< part of a sweep's rows: "2/8"
  int threads = 0;
};

/// Input of every command that works on a study. All ranks call a command that uses ranks; only the
/// first one writes files and prints to its console.
struct CommandInput {
  const Study& study;
  const ResultsFolder& folder;
  const Console& console;
  std::filesystem::path target = {};  ///< file that `export` writes
  bool is_binary = false;             ///< `export` writes the binary variant
  fe_modal::Ranks ranks = {};         ///< the ranks that mpirun has started
  bool redo = false;                  ///< `run` also recomputes stages that have not changed
  bool is_run = false;                ///< called by `run`, which recomputes all later stages
  bool sensitivity = false;           ///< `modes` also computes its derivatives
  WorkShares shares = {};
};

/// True if this process writes files.
inline bool writes(const CommandInput& input) { return input.ranks.is_first(); }

/// Number of threads asked for, by default the number of processors.
inline unsigned threads_of(const CommandInput& input) {
  if (input.shares.threads > 0) return static_cast<unsigned>(input.shares.threads);
  return std::max(1U, std::thread::hardware_concurrency());
}

/// The curves to rate, as given by the user; empty where nothing is given.
struct CurveChoice {
  std::string channel;            ///< column of both files
  std::string reference_channel;  ///< column of the reference, if it has another name
  std::string unit;               ///< unit for files that name none
  std::string from, to;           ///< times with their units
};

/// The columns with the loads of the neck.
struct NeckLoadChoice {
  std::string force, moment;  ///< along z and about y
  std::string shear;          ///< along x, if the moment is about a load cell; else empty
  std::string dummy = "50th-male";
};

/// Input of the commands that work on given files instead of a study.
struct FileInput {
  std::vector<std::filesystem::path> files;
  std::vector<std::string> settings;
  const ResultsFolder& folder;  ///< its path is empty if nothing is to be written
  const Console& console;
  CurveChoice curves = {};
  NeckLoadChoice neck_loads = {};
  std::filesystem::path target = {};  ///< file that `export` writes
  bool is_binary = false;             ///< `export` writes the binary variant
};

}  // namespace flexneck::pipeline
