// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/support/run_command.h"

namespace flexneck::testing {

/// Frequencies in Hz from CalculiX's printed results, the file .dat; seven digits. Empty if it has
/// none.
inline std::vector<double> read_calculix_frequencies(const std::filesystem::path& printed) {
  std::ifstream file(printed);
  std::vector<double> frequencies;
  bool in_table = false;
  for (std::string line; std::getline(file, line);) {
    if (line.find("E I G E N V A L U E") != std::string::npos) in_table = true;
    if (line.find("P A R T I C I P A T I O N") != std::string::npos) break;
    std::istringstream numbers(line);
    double mode = 0;
    double eigenvalue = 0;
    double radians = 0;
    double hertz = 0;
    if (in_table && numbers >> mode >> eigenvalue >> radians >> hertz) frequencies.push_back(hertz);
  }
  return frequencies;
}

/// Frequencies in Hz that CalculiX (package calculix-ccx) computes for a deck.
inline std::vector<double> calculix_frequencies(const std::filesystem::path& deck) {
  const std::string job = deck.stem().string();
  const CommandOutcome outcome =
      run_shell("cd '" + deck.parent_path().string() + "' && OMP_NUM_THREADS=1 ccx -i " + job);
  const std::vector<double> frequencies =
      read_calculix_frequencies(deck.parent_path() / (job + ".dat"));
  if (frequencies.empty()) throw std::runtime_error("ccx found no frequency: " + outcome.text);
  return frequencies;
}

}  // namespace flexneck::testing
