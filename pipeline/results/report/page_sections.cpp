// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/results/report/page_sections.h"

#include <algorithm>
#include <string>

#include <fmt/core.h>

#include "fe_modal/body/basis_table.h"
#include "pipeline/results/plotting/embedding.h"
#include "pipeline/results/report/corridors.h"
#include "pipeline/results/report/html_badges.h"
#include "pipeline/results/report/results.h"
#include "pipeline/results/tables/sensitivity_tables.h"

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

/// Text such as "All 6 figures that are judged agree. …".
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
    return "No figure has a verdict, since dimensions or materials are those of the user "
           "(synthetic).";
  std::string text = failed == 0 ? fmt::format("All {} figures with a verdict agree.", passed)
                                 : fmt::format("{} of the {} figures with a verdict do not agree.",
                                               failed, passed + failed);
  if (is_fitted) {
    text +=
        " The dimensions were fitted to the figures marked as fitted: agreement there shows the "
        "quality of the fit, not the predictive ability of the model.";
  }
  return text;
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

/// HTML of the page's first screen beside the moving neck: the computations, and each verdict.
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

using Status = VerificationRow::Status;

std::string note(const std::string& html) { return "<p class=\"note\">" + html + "</p>\n"; }

std::string verdict(const VerificationRow& row) {
  std::string html = row.status == Status::passed   ? passed_badge()
                     : row.status == Status::failed ? failed_badge()
                                                    : "";
  if (row.fitted) html += (html.empty() ? "" : " ") + badge("calibrated", "◆", "fitted");
  return html;
}

std::string verification_html(const Results& results, const Study& study) {
  if (!results.verification)
    return study.verification.empty() ? "" : note("There is no comparison in this folder yet.");
  HtmlTable table;
  table.name = "verification";
  const std::string& reference = results.verification->reference_origins;
  table.caption = "Computed vs. " + reference;
  table.columns = {{"quantity"},
                   {"how"},
                   {"computed", true, kOfRow},
                   {reference, true, kOfRow},
                   {"unit", false, "", true},
                   {"error %", true},
                   {"verdict"}};
  for (const VerificationRow& row : results.verification->rows) {
    table.rows.push_back(
        {{html_text(row.quantity), html_text(row.detail), html_text(row.value),
          html_text(row.reference), html_text(row.unit),
          row.error_percent ? fmt::format("{:+.2f}", *row.error_percent) : "", verdict(row)}});
  }
  return note(html_text(verification_summary(*results.verification))) + html_of(table);
}

/// True if a text begins with a digit, or a sign and a digit, and contains no word after the
/// number.
bool looks_like_number(const std::string& text) {
  const std::size_t first = text.find_first_not_of("+- ");
  return first != std::string::npos && text[first] >= '0' && text[first] <= '9' &&
         text.find(' ', first) == std::string::npos;
}

/// True for the table of verdicts, which has a section of its own.
bool is_verdicts(const ResultTable& table) { return table.name == "verdicts"; }

std::string certification_html(const Results& results, const Study& study) {
  std::string html;
  for (const ResultTable& result : results.tables) {
    if (!is_verdicts(result)) continue;
    HtmlTable table = html_table_of(result);
    for (HtmlTable::Row& row : table.rows)
      for (std::string& cell : row.cells)
        cell = cell == "pass" ? passed_badge() : cell == "FAIL" ? failed_badge() : cell;
    html += html_of(table) + html_list(result.notes);
  }
  if (!html.empty() || study.tests.empty()) return html;
  return note(
      "There are no verdicts in this folder yet; <code>flexneck verify</code> creates them.");
}

std::string tables_html(const Results& results, const Study& study) {
  std::string html;
  for (const ResultTable& table : results.tables) {
    if (is_verdicts(table) || is_of_sensitivities(table)) continue;
    html += html_of(html_table_of(table)) + html_list(table.notes);
  }
  if (!html.empty() || study.cases.empty()) return html;
  return note("There are no tables of experiments in this folder yet.");
}

/// HTML of the sensitivities without the list of all derivatives, which is for programs.
std::string sensitivities_html(const Results& results) {
  std::string html;
  for (const ResultTable& table : results.tables) {
    if (!is_of_sensitivities(table) || table.name == kSensitivityTable) continue;
    html += html_of(html_table_of(table)) + html_list(table.notes);
  }
  if (html.empty()) return html;
  return html + note(
                    "All derivatives with their units: the table \"sensitivities\" in "
                    "sensitivities.json.");
}

HtmlTable mode_table_of(const fe_modal::ModalBody& body) {
  HtmlTable table;
  table.name = "modes";
  table.caption = "Modes: " + body.boundary;
  table.columns = {{"mode"}, {"kind"}, {"Hz", true}};
  const bool with_shares = fe_modal::has_shares(body);
  if (with_shares)
    for (const char* const share : {"fore-aft %", "lateral %", "twist %", "axial %"})
      table.columns.push_back({share, true});
  table.columns.push_back({"residual", true});
  table.columns.push_back(
      {body.mesh_error_limits.empty() ? "mesh error %" : "indicated error %", true});
  for (std::size_t k = 0; k < body.modes.size(); ++k) {
    const fe_modal::ModeRecord& mode = body.modes[k];
    HtmlTable::Row row{{html_text(mode.name), html_text(mode.kind),
                        fmt::format("{:.3f}", body.frequencies_Hz[static_cast<Eigen::Index>(k)])}};
    if (with_shares)
      for (const double share : mode.shares_percent)
        row.cells.push_back(fmt::format("{:.2f}", share));
    row.cells.push_back(fmt::format("{:.1e}", mode.residual));
    row.cells.push_back(mode.mesh_error ? fmt::format("{:.3f}", 100 * mode.mesh_error->error)
                                        : "not estimated");
    table.rows.push_back(std::move(row));
  }
  return table;
}

std::string modes_html(const Results& results) {
  if (!results.modes) return note("There are no modes in this folder yet.");
  const fe_modal::ModalBody& body = *results.modes;
  std::string html = "<dl>\n<dt>Completeness</dt><dd>" + html_text(body.completeness);
  if (body.completeness == "not checked") {
    html += ". <code>flexneck modes --check</code> checks that no mode is missing";
  }
  html += "</dd>\n<dt>Orthogonality</dt><dd>largest entry of |ΨᵀMΨ − I|: " +
          fmt::format("{:.1e}", body.orthogonality) + "</dd>\n<dt>Solver</dt><dd>" +
          html_text(body.solver) + "</dd>\n";
  for (const fe_modal::AttachedFrequencies& attached : body.attached) {
    html += "<dt>With " + html_text(attached.body + " on " + attached.interface) + "</dt><dd>";
    for (const double frequency : attached.frequencies_Hz)
      html += fmt::format("{:.3f} ", frequency);
    html += "Hz, finite elements, no gravity</dd>\n";
  }
  if (!body.mesh_error_limits.empty())
    html +=
        "<dt>Discretisation errors</dt><dd>only indicative: " + html_text(body.mesh_error_limits) +
        "</dd>\n";
  return html + "</dl>\n" + html_of(mode_table_of(body));
}

std::string parameters_html(const Study& study) {
  std::string buttons;
  for (std::size_t i = 0; i < kOriginNames.size(); ++i) {
    const auto origin = static_cast<Origin>(i);
    const auto count = std::count_if(study.parameters.begin(), study.parameters.end(),
                                     [&](const Parameter& each) { return each.origin == origin; });
    buttons += fmt::format(
        "<button type=\"button\" aria-pressed=\"true\" data-origin=\"{}\">{} {}</button>\n",
        name_of(origin), origin_badge(origin), count);
  }
  HtmlTable table;
  table.name = "parameters";
  table.caption = "Every input of the study";
  table.columns = {{"input"}, {"value"}, {"origin"}, {"source or reason"}};
  for (const Parameter& parameter : study.parameters) {
    table.rows.push_back(
        {{"<code>" + html_text(parameter.key) + "</code>", html_text(parameter.value),
          origin_badge(parameter.origin), html_text(parameter.note)},
         fmt::format("data-origin=\"{}\"", name_of(parameter.origin))});
  }
  return "<div class=\"controls\" id=\"origins\" role=\"group\" aria-label=\"Origins shown\">\n" +
         buttons + "</div>\n" + html_of(table);
}

std::string provenance_html(const Results& results, const Study& study) {
  HtmlTable files;
  files.name = "files";
  files.caption = "Files read for this page";
  files.columns = {{"file"}, {"made by"}, {"sources"}, {"XXH3 of its contents"}};
  for (const ResultFile& file : results.files) {
    files.rows.push_back({{html_text(file.name), html_text(file.provenance.program),
                           "<code>" + html_text(file.provenance.git_hash) + "</code>",
                           "<code>" + html_text(file.hash) + "</code>"}});
  }
  HtmlTable inputs;
  inputs.name = "inputs";
  inputs.caption = "Files of the study";
  inputs.columns = {{"file"}, {"XXH3 of its contents"}};
  for (const InputFile& input : study.files) {
    inputs.rows.push_back({{html_text(input.name), "<code>" + html_text(input.hash) + "</code>"}});
  }
  std::string libraries;
  for (const ResultFile& file : results.files) {
    for (const auto& [name, version] : file.provenance.libraries) {
      const std::string entry = name + " " + version;
      if (libraries.find(entry) == std::string::npos)
        libraries += (libraries.empty() ? "" : ", ") + entry;
    }
  }
  return html_of(files) + html_of(inputs) +
         (libraries.empty() ? "" : note("Libraries: " + html_text(libraries) + "."));
}

std::string missing_html(const Results& results) {
  if (results.missing.empty()) return note("All results that the study requests are on this page.");
  return "<p>Not on this page:</p>\n" + html_list(results.missing);
}

}  // namespace

HtmlTable html_table_of(const ResultTable& result) {
  HtmlTable table;
  table.name = result.name;
  table.caption = result.title;
  const auto names_unit = [](const ResultTable::Column& column) { return column.name == "unit"; };
  const auto row_unit = std::find_if(result.columns.begin(), result.columns.end(), names_unit) -
                        result.columns.begin();
  const bool has_row_unit = row_unit < static_cast<std::ptrdiff_t>(result.columns.size());
  for (std::size_t c = 0; c < result.columns.size(); ++c) {
    const auto& [name, unit] = result.columns[c];
    const bool is_number =
        c > 0 && std::any_of(result.rows.begin(), result.rows.end(), [&](const auto& row) {
          return c < row.size() && looks_like_number(row[c]);
        });
    const bool is_of_row = has_row_unit && is_number && static_cast<std::ptrdiff_t>(c) < row_unit;
    table.columns.push_back(
        {name, is_number, is_of_row ? kOfRow : unit, names_unit(result.columns[c])});
  }
  for (const auto& cells : result.rows) {
    HtmlTable::Row row;
    std::transform(cells.begin(), cells.end(), std::back_inserter(row.cells), html_text);
    table.rows.push_back(std::move(row));
  }
  return table;
}

std::map<std::string, std::string> page_sections(const Results& results, const Study& study,
                                                 const std::vector<std::string>& paper_remarks) {
  std::vector<std::string> remarks = paper_remarks;
  const std::vector<std::string> on_pulses = pulse_remarks(study);
  if (!remarks.empty()) remarks.insert(remarks.end(), on_pulses.begin(), on_pulses.end());
  return {{"study", html_text(study.file.filename().string())},
          {"warnings", html_list(results.all_warnings())},
          {"subject", study.neck() != nullptr
                          ? "From the geometry of a crash-test dummy's neck to its motion: "
                            "modes by finite elements, the static neck tester and the "
                            "head/neck pendulum."
                          : "From a geometry to its modes by finite elements."},
          {"summary", summary_html(results, study)},
          {"certification", certification_html(results, study)},
          {"verification", verification_html(results, study)},
          {"tables", tables_html(results, study)},
          {"modes", modes_html(results)},
          {"sensitivities", sensitivities_html(results)},
          {"remarks", html_list(remarks)},
          {"parameters", parameters_html(study)},
          {"provenance", provenance_html(results, study) + missing_html(results)}};
}

}  // namespace flexneck::pipeline
