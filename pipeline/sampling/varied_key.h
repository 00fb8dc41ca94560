// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "pipeline/evaluation/evaluator.h"

namespace flexneck::pipeline {

/// A key of the study that is given other values.
struct VariedKey {
  std::string who;   ///< for messages, such as "sweep.parameter 'mass'"
  std::string key;   ///< dotted
  std::string unit;  ///< of its numbers; empty for pure ones
};

struct SiUnit {
  std::string name;   ///< "1" for a pure number
  double factor = 1;  ///< from the unit of the key's numbers
};

/// The SI unit that belongs to a unit which the key may have; of a variable, any that the study
/// knows.
/// @throws InputError for a unit that its key does not have.
SiUnit si_unit_of(const VariedKey& varied);

/// "key=value" as --set takes it.
/// @param value  in the unit of the key's numbers
std::string setting_of(const VariedKey& varied, double value);

/// Two settings of one key, for whether anything depends on it.
struct TwoSettings {
  VariedKey varied;
  std::string first;
  std::string second;
};

/// Reads the study with two values of each key, the others as they are. A value that the study
/// refuses is a matter of those who use it, unless it refuses both.
/// @param own_table  keys of which cannot be varied, such as "sweep"
/// @param outputs    what the wanted outputs are called in messages
/// @throws InputError for a key of which it does, that no output depends on, or that comes twice.
void check_varied(Evaluator& evaluator, const std::vector<TwoSettings>& all,
                  const WantedOutputs& wanted, const std::string& own_table,
                  const std::string& outputs);

/// Hash of the program and of every value of the study. Rows know the files that they are made from
/// (row_file.h).
std::string definition_of(const Study& study);

}  // namespace flexneck::pipeline
