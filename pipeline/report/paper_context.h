// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "pipeline/document/key.h"
#include "pipeline/study/study.h"

namespace flexneck::pipeline {

/// A range that a standard asks a curve to pass through, shown behind the curves for context.
/// Nothing is judged by it: the tests of the paper are not those of the standard.
struct Corridor {
  std::string experiment;                   ///< name of the pendulum's case
  double slowest_m_s = 0, fastest_m_s = 0;  ///< impact velocities that the standard has it for
  std::string channel;                      ///< name of the channel
  std::string what;                         ///< "largest rotation", "first return to zero"
  std::string unit;                         ///< of the channel, SI
  double from_s = 0, to_s = 0;
  double low = 0, high = 0;  ///< in that unit
};

/// What a standard asks of a pulse.
struct PulseCorridor {
  std::string what;  ///< "the flexion corridor of …"
  std::vector<double> times_s, low_m_s2, high_m_s2;
  double most_after_m_s2 = 0;  ///< after the last of the times
  double decay_level_m_s2 = 0;
  double decay_from_s = 0, decay_to_s = 0;  ///< when the pulse falls below that level for good
};

/// Whether a deceleration, linear between its times, keeps to all of it.
bool is_inside(const PulseSection& pulse, const PulseCorridor& corridor);

struct PaperContext {
  std::vector<Corridor> corridors;
  std::string corridor_source;  ///< in full
  std::string corridor_label;   ///< beside a curve
  std::vector<PulseCorridor> pulse_corridors;
  std::vector<std::string> remarks;  ///< where the paper contradicts itself or says too little
};

/// The table of keys of such a file.
std::span<const Key> context_keys();

/// What holds for a study: the corridors of cases at their velocities only.
/// @throws InputError if the file does not say what it must.
PaperContext read_context(const std::filesystem::path& path, const Study& study);

/// A sentence on each pulse in use: its origin, and the corridors that it is inside of as the study
/// gives it.
std::vector<std::string> pulse_remarks(const Study& study, const PaperContext& context);

}  // namespace flexneck::pipeline
