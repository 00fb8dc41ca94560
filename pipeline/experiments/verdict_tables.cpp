// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/experiments/verdict_tables.h"

#include <algorithm>

#include <fmt/core.h>

namespace flexneck::pipeline {

using Status = JudgedTest::Status;

namespace {

std::string verdict_word(const JudgedTest& test) {
  if (test.status == Status::not_applicable) return "not applicable";
  if (test.status == Status::not_run) return "not run";
  return test.verdict->passed() ? "pass" : "FAIL";
}

/// Text "met", or the conditions that are not: "velocity outside", "pulse outside".
std::string conditions_text(const Verdict& verdict) {
  std::string outside;
  for (const JudgedFigure& figure : verdict.unmet_conditions()) {
    const char* const what = figure.name == "impact velocity" ? "velocity" : "pulse";
    if (outside.find(what) == std::string::npos)
      outside += (outside.empty() ? "" : " and ") + std::string(what);
  }
  return outside.empty() ? "met" : outside + " outside";
}

std::vector<std::string> row_of(const JudgedTest& test) {
  std::vector<std::string> row = {test.test.name, test.test.rules.name, test.test.experiment,
                                  verdict_word(test)};
  if (!test.verdict) {
    row.insert(row.end(), {"-", "-", "-", "-"});
    return row;
  }
  const JudgedFigure& furthest = test.verdict->furthest();
  row.push_back(
      fmt::format("{} of {}", test.verdict->passed_count(), test.verdict->figures.size()));
  row.push_back(furthest.name);
  row.push_back(furthest.value ? text_of(furthest, test.test.rules).distance : "not found");
  row.push_back(conditions_text(*test.verdict));
  return row;
}

/// Appends a note unless it is present.
void add_note(std::vector<std::string>& notes, const std::string& note) {
  if (std::find(notes.begin(), notes.end(), note) == notes.end()) notes.push_back(note);
}

void add_figures(ResultTable& table, const JudgedTest& test,
                 const std::vector<JudgedFigure>& figures, const char* inside,
                 const char* outside) {
  for (const JudgedFigure& figure : figures) {
    const FigureText text = text_of(figure, test.test.rules);
    table.rows.push_back({test.test.name, figure.name, text.value, text.limits, text.unit,
                          figure.is_inside() ? inside : outside, text.distance});
  }
}

}  // namespace

bool applies(const TestSection& test, const Study& study) {
  return test.rules.dummy == study.dummy;
}

std::vector<std::string> verdict_warnings(const std::vector<JudgedTest>& tests) {
  std::vector<std::string> warnings;
  for (const JudgedTest& test : tests) {
    if (!test.verdict) continue;
    const std::string where = "test '" + test.test.name + "', case " + test.test.experiment + ": ";
    for (const JudgedFigure& figure : test.verdict->unmet_conditions())
      warnings.push_back(where + outside_text(figure, test.test.rules));
    if (!test.moment_difference.empty()) warnings.push_back(where + test.moment_difference);
  }
  return warnings;
}

ResultTable verdict_table(const std::vector<JudgedTest>& tests, const Study& study) {
  ResultTable table;
  table.name = "verdicts";
  table.title = "Certification tests of regulations";
  table.columns = {{"test", ""},   {"regulation", ""}, {"case", ""},       {"verdict", ""},
                   {"inside", ""}, {"furthest", ""},   {"off centre", ""}, {"conditions", ""}};
  for (const JudgedTest& test : tests) {
    table.rows.push_back(row_of(test));
    const TestSection& section = test.test;
    if (test.status == Status::not_applicable)
      add_note(table.notes, section.rules.name + " is for the dummy '" + section.rules.dummy +
                                "', the study's is '" + study.dummy + "'.");
    if (test.status == Status::not_run)
      add_note(table.notes,
               "There is no run of " + section.experiment + " yet; 'flexneck pendulum' makes it.");
  }
  for (const std::string& warning : verdict_warnings(tests))
    table.notes.push_back("Warning: " + warning + ".");
  return table;
}

ResultTable verdict_figure_table(const std::vector<JudgedTest>& tests) {
  ResultTable table;
  table.name = kVerdictFigures;
  table.title = "Figures and conditions of the certification tests";
  table.columns = {{"test", ""}, {"figure", ""},  {"value", ""},     {"limits", ""},
                   {"unit", ""}, {"verdict", ""}, {"off centre", ""}};
  for (const JudgedTest& test : tests) {
    if (!test.verdict) continue;
    add_figures(table, test, test.verdict->figures, "pass", "FAIL");
    add_figures(table, test, test.verdict->conditions, "met", "outside");
    add_note(table.notes, "Limits: " + test.test.rules.source + ".");
  }
  table.notes.emplace_back(
      "Off centre: deviation from the middle of the limits, divided by half the distance of the "
      "limits. Velocity and pulse are conditions of a test; if they are outside their limits, a "
      "warning is given and the test does not fail.");
  return table;
}

}  // namespace flexneck::pipeline
