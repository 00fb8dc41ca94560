// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "pipeline/parameter_studies/evaluation/evaluator.h"

namespace flexneck::pipeline {

/// A key of the study that is given other values.
struct VariedKey {
  std::string who;   ///< description for messages, such as "sweep.parameter 'mass'"
  std::string key;   ///< dotted name
  std::string unit;  ///< unit of its numbers; empty for pure ones
};

struct SiUnit {
  std::string name;   ///< "1" for a pure number
  double factor = 1;  ///< factor from the unit of the key's numbers
};

/// The SI unit of a unit that the key may have; for a variable, of any unit that the study knows.
/// @throws InputError for a unit that its key does not have.
SiUnit si_unit_of(const VariedKey& varied);

/// Setting "key=value" as for --set.
/// @param value  in the unit of the key's numbers
std::string setting_of(const VariedKey& varied, double value);

/// Two settings of one key, to test whether an output depends on it.
struct TwoSettings {
  VariedKey varied;
  std::string first;
  std::string second;
};

/// Reads the study with two values of each key, the others unchanged. A value that the study
/// refuses is accepted here unless both are refused.
/// @param own_table  table whose keys cannot be varied, such as "sweep"
/// @param outputs    name of the wanted outputs in messages
/// @throws InputError for a key of which both values are refused, on which no output depends, or
/// that occurs twice.
void check_varied(Evaluator& evaluator, const std::vector<TwoSettings>& all,
                  const WantedOutputs& wanted, const std::string& own_table,
                  const std::string& outputs);

/// Hash of the program and of every value of the study. Rows record the files that they are made
/// from (row_file.h).
std::string definition_of(const Study& study);

}  // namespace flexneck::pipeline
