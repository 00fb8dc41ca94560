// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace flexneck::pipeline {

/// A range that a standard asks a curve to pass through, shown behind the curves for context.
/// Nothing is judged by it: the tests of the paper are not those of the standard.
struct Corridor {
  std::string experiment;  ///< name of the pendulum's case
  std::string channel;     ///< name of the channel
  std::string what;        ///< "largest rotation", "first return to zero"
  std::string unit;        ///< of the channel, SI
  double from_s = 0, to_s = 0;
  double low = 0, high = 0;  ///< in that unit
};

struct PaperContext {
  std::vector<Corridor> corridors;
  std::string corridor_source;
  std::vector<std::string> remarks;  ///< where the paper contradicts itself or says too little
};

/// @throws InputError if the file does not say what it must.
PaperContext read_context(const std::filesystem::path& path);

}  // namespace flexneck::pipeline
