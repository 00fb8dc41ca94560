// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <random>
#include <string>

namespace flexneck::campaigns {

/// One random case: its random numbers, and the folder for the inputs of a finding.
struct Case {
  std::uint64_t number;
  std::mt19937_64 random;
  std::string folder;
  bool was_refused = false;  ///< set by the judgement if a refusal is right

  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  }
  int whole(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); }
  bool chance(double probability) { return between(0, 1) < probability; }
};

/// Judges a case: returns one line on what is wrong with its result; nothing if the case is right
/// or was rightly refused. An exception is a finding, too.
using Judgement = std::function<std::optional<std::string>(Case&)>;

/// Runs a campaign as `PROGRAM --seed TEXT --runs N --out FOLDER [--only NUMBER]`: the same seed
/// and number give the same case. Prints each finding as a line, also to FOLDER/findings.txt, and
/// the number of refused cases.
/// @return the exit code: 0 without a finding, 1 with findings, 2 if the arguments are unusable.
int run(int argc, char** argv, const Judgement& judge);

}  // namespace flexneck::campaigns
