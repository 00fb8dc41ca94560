// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/results/report/page_summary.h"

#include <algorithm>

#include <fmt/core.h>

#include "pipeline/results/plotting/embedding.h"
#include "pipeline/results/report/html_badges.h"

namespace flexneck::pipeline {

namespace {

using Status = VerificationRow::Status;

std::string counted(std::size_t count, const std::string& one, const std::string& many) {
  return fmt::format("{} {}", count, count == 1 ? one : many);
}

/// Text such as "10 modes from 35.9 to 310 Hz, 24 runs of the pendulum, 3 static tests".
std::string what_was_run(const Results& results) {
  std::string text;
  const auto add = [&](const std::string& part) { text += (text.empty() ? "" : ", ") + part; };
  if (results.modes && results.modes->frequencies_Hz.size() > 0) {
    const Eigen::VectorXd& frequencies_Hz = results.modes->frequencies_Hz;
    add(counted(results.modes->modes.size(), "mode", "modes") +
        fmt::format(" from {:.1f} to {:.1f} Hz", frequencies_Hz.minCoeff(),
                    frequencies_Hz.maxCoeff()));
  }
  const auto runs_of = [&](Experiment::Kind kind) {
    return static_cast<std::size_t>(
        std::count_if(results.experiments.begin(), results.experiments.end(),
                      [&](const Experiment& each) { return each.kind == kind; }));
  };
  if (const auto runs = runs_of(Experiment::Kind::pendulum); runs > 0)
    add(counted(runs, "run of the pendulum", "runs of the pendulum"));
  if (const auto runs = runs_of(Experiment::Kind::static_test); runs > 0)
    add(counted(runs, "static test", "static tests"));
  return text.empty() ? "nothing yet" : text;
}

std::string item(const std::string& section, const std::string& name, const std::string& badge,
                 const std::string& sentence) {
  return "<li><a href=\"#" + section + "\">" + html_text(name) + "</a> " + badge +
         (badge.empty() ? "" : " ") + html_text(sentence) + "</li>\n";
}

std::string verification_item(const VerificationTable& table) {
  const auto has = [&](Status status) {
    return std::any_of(table.rows.begin(), table.rows.end(),
                       [&](const VerificationRow& row) { return row.status == status; });
  };
  const std::string badge = has(Status::failed)   ? failed_badge()
                            : has(Status::passed) ? passed_badge()
                                                  : "";
  const std::string sentence = verification_summary(table);
  return item("verification", "Verification", badge, sentence.substr(0, sentence.find(". ") + 1));
}

std::string cell(const ResultTable& table, const std::vector<std::string>& row,
                 const std::string& column) {
  for (std::size_t c = 0; c < table.columns.size() && c < row.size(); ++c)
    if (table.columns[c].name == column) return row[c];
  return {};
}

/// HTML list items, one for each test of a regulation.
std::string certification_items(const Results& results) {
  std::string html;
  for (const ResultTable& table : results.tables) {
    if (table.name != "verdicts") continue;
    for (const std::vector<std::string>& row : table.rows) {
      const std::string verdict = cell(table, row, "verdict");
      const std::string badge = verdict == "pass"   ? passed_badge()
                                : verdict == "FAIL" ? failed_badge()
                                                    : html_text(verdict);
      const std::string inside = cell(table, row, "inside");
      html += item(
          "certification", cell(table, row, "regulation"), badge,
          cell(table, row, "case") + (inside.empty() ? "" : ", " + inside + " figures inside"));
    }
  }
  return html;
}

}  // namespace

std::string verification_summary(const VerificationTable& table) {
  const auto count = [&](Status status) {
    return std::count_if(table.rows.begin(), table.rows.end(),
                         [&](const VerificationRow& row) { return row.status == status; });
  };
  const auto passed = count(Status::passed);
  const auto failed = count(Status::failed);
  const bool is_fitted = std::any_of(table.rows.begin(), table.rows.end(),
                                     [](const VerificationRow& row) { return row.fitted; });
  if (passed + failed == 0)
    return "Nothing is judged: dimensions or materials are the user's own (synthetic).";
  std::string text = failed == 0 ? fmt::format("All {} figures that are judged agree.", passed)
                                 : fmt::format("{} of the {} figures that are judged do not agree.",
                                               failed, passed + failed);
  if (is_fitted) {
    text +=
        " Where it says fitted, the dimensions were fitted to that figure: agreement there shows "
        "that the fit was done well, not that the model predicts.";
  }
  return text;
}

std::string summary_html(const Results& results, const Study& study) {
  std::string items;
  if (const std::size_t count = results.all_warnings().size(); count > 0)
    items += item("warnings", "Warnings", badge("failed", "⚠", std::to_string(count)),
                  "Read these before you use the results.");
  if (results.verification) items += verification_item(*results.verification);
  items += certification_items(results);
  std::string made_by;
  if (!results.files.empty()) {
    const Provenance& provenance = results.files.front().provenance;
    made_by = ", by " + provenance.program + " (" + provenance.git_hash + ")";
  }
  return "<p>Run of <b>" + html_text(study.file.filename().string()) +
         "</b>: " + html_text(what_was_run(results) + made_by) + ".</p>\n" +
         (items.empty() ? "" : "<ul class=\"verdicts\">\n" + items + "</ul>\n");
}

}  // namespace flexneck::pipeline
