// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pipeline/laboratory/verdict/verdict.h"
#include "pipeline/language/study/study.h"
#include "pipeline/process/result_table.h"

namespace flexneck::pipeline {

/// Name of the table with all figures.
inline constexpr const char* kVerdictFigures = "verdict figures";

/// A test of the study with its judgement of the case.
struct JudgedTest {
  enum class Status {
    judged,
    not_applicable,  ///< the regulation is for another dummy
    not_run          ///< there is no run of the case yet
  };
  TestSection test;
  Status status = Status::not_run;
  std::optional<Verdict> verdict = {};  ///< present if the test is judged
  /// The difference, if the case and the test define the moment differently.
  std::string moment_difference = {};
};

/// Returns whether the test's regulation is for the dummy of the study.
bool applies(const TestSection& test, const Study& study);

/// Warnings: conditions of tests that are not met, with the place and the amount, and moments that
/// are defined differently.
std::vector<std::string> verdict_warnings(const std::vector<JudgedTest>& tests);

/// Table "verdicts": a line for each test.
ResultTable verdict_table(const std::vector<JudgedTest>& tests, const Study& study);
/// Table "verdict figures": each figure and each condition with its limits.
ResultTable verdict_figure_table(const std::vector<JudgedTest>& tests);

}  // namespace flexneck::pipeline
