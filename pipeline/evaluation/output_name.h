// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "pipeline/study/study.h"

namespace flexneck::pipeline {

/// What a figure or a curve of a study is called: "modes.<figure>", "pendulum.<case>.<figure>",
/// "static.<case>.<figure>", "verdict.<test>.<figure>". README.md lists the figures.
struct OutputName {
  enum class Of { modes, pendulum, static_test, verdict };
  std::string text;  ///< as given
  Of of = Of::modes;
  std::string owner;   ///< case or test; empty of the modes
  std::string figure;  ///< or the channel of a curve
};

/// @throws InputError for what is no such name, or of a case or test that the study has not.
OutputName output_name(const std::string& text, const Study& study);

/// The case whose experiment gives an output. @pre output.of is not Of::modes
const CaseSection& case_of(const OutputName& output, const Study& study);
/// @pre output.of is Of::verdict
const TestSection& test_of(const OutputName& output, const Study& study);

/// Whether it is a frequency with the body attached.
bool is_of_attached(const OutputName& output);

/// All that an output is computed from, as text: it differs between two studies only if the output
/// may.
std::string values_behind(const OutputName& output, const Study& study);

}  // namespace flexneck::pipeline
