// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/results/report/page_sections.h"

#include <algorithm>

#include <fmt/core.h>

#include "fe_modal/body/basis_table.h"
#include "pipeline/results/plotting/embedding.h"
#include "pipeline/results/report/corridors.h"
#include "pipeline/results/report/html_badges.h"
#include "pipeline/results/report/page_summary.h"
#include "pipeline/results/tables/sensitivity_tables.h"

namespace flexneck::pipeline {

namespace {

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
  return note("There are no verdicts in this folder yet; <code>flexneck verify</code> makes them.");
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
        "<dt>Errors of the mesh</dt><dd>an indication alone: " + html_text(body.mesh_error_limits) +
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
  if (results.missing.empty()) return note("Nothing that the study asks for is missing.");
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
