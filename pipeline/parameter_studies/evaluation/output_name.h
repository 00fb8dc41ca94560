// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "pipeline/language/study/study.h"

namespace flexneck::pipeline {

/// Name of a figure or a curve of a study: "modes.<figure>", "pendulum.<case>.<figure>",
/// "static.<case>.<figure>", "verdict.<test>.<figure>". parameter_studies.md lists the figures.
struct OutputName {
  enum class Of { modes, pendulum, static_test, verdict };
  std::string text;  ///< name as given
  Of of = Of::modes;
  std::string owner;   ///< case or test; empty for the modes
  std::string figure;  ///< name of the figure, or of the channel for a curve
};

/// Parses a name.
/// @throws InputError for an invalid name, or a case or test that the study does not have.
OutputName output_name(const std::string& text, const Study& study);

/// The case whose experiment produces an output. @pre output.of is not Of::modes
const CaseSection& case_of(const OutputName& output, const Study& study);
/// The test of a verdict's output. @pre output.of is Of::verdict
const TestSection& test_of(const OutputName& output, const Study& study);

/// True for a frequency with the body attached.
bool is_of_attached(const OutputName& output);

/// Text of all values that an output depends on: it differs between two studies only if the output
/// may differ.
std::string values_behind(const OutputName& output, const Study& study);

}  // namespace flexneck::pipeline
