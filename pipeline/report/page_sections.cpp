// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/report/page_sections.h"

#include <algorithm>
#include <array>

#include <fmt/core.h>

#include "fe_modal/body/basis_table.h"
#include "pipeline/output/sensitivity_tables.h"
#include "pipeline/plotting/embedding.h"
#include "pipeline/report/corridors.h"

namespace flexneck::pipeline {

namespace {

using Status = VerificationRow::Status;

std::string note(const std::string& html) { return "<p class=\"note\">" + html + "</p>\n"; }

/// A word in a frame with a sign of its own, so that it does not need its colour.
std::string badge(const std::string& kind, const std::string& sign, const std::string& word) {
  return "<span class=\"badge " + kind + "\"><span aria-hidden=\"true\">" + sign + "</span> " +
         word + "</span>";
}

std::string origin_badge(Origin origin) {
  static constexpr std::array<const char*, 4> kSigns = {"■", "◇", "◆", "○"};
  const std::string name(name_of(origin));
  return badge(name, kSigns[static_cast<std::size_t>(origin)], name);
}

std::string passed_badge() { return badge("passed", "✓", "pass"); }
std::string failed_badge() { return badge("failed", "✗", "FAIL"); }

std::string verdict(const VerificationRow& row) {
  std::string html = row.status == Status::passed   ? passed_badge()
                     : row.status == Status::failed ? failed_badge()
                                                    : "";
  if (row.fitted) html += (html.empty() ? "" : " ") + badge("calibrated", "◆", "fitted");
  return html;
}

/// "All 6 published frequencies are met within the tolerance; …"
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

std::string verification_html(const Results& results, const Study& study) {
  if (!results.verification)
    return study.verification.empty() ? "" : note("There is no comparison in this folder yet.");
  HtmlTable table;
  table.name = "verification";
  const std::string& reference = results.verification->reference_origins;
  table.caption = "Computed vs. " + reference;
  table.columns = {{"quantity"}, {"how"},           {"computed", true}, {reference, true},
                   {"unit"},     {"error %", true}, {"verdict"}};
  for (const VerificationRow& row : results.verification->rows) {
    table.rows.push_back(
        {{html_text(row.quantity), html_text(row.detail), html_text(row.value),
          html_text(row.reference), html_text(row.unit),
          row.error_percent ? fmt::format("{:+.2f}", *row.error_percent) : "", verdict(row)}});
  }
  return note(html_text(verification_summary(*results.verification))) + html_of(table);
}

/// Numbers begin with a digit or a sign before one.
bool looks_like_number(const std::string& text) {
  const std::size_t first = text.find_first_not_of("+- ");
  return first != std::string::npos && text[first] >= '0' && text[first] <= '9';
}

/// This one has a section of its own.
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

/// The list of all derivatives is for programs.
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
  table.columns.push_back({"mesh error %", true});
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
  std::string html = "<dl>\n<dt>Completeness</dt><dd>" + html_text(body.certificate);
  if (body.certificate == "not certified") {
    html += ". <code>flexneck modes --certify</code> proves that no mode is missing";
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

std::string warnings_html(const Results& results) {
  if (results.warnings.empty()) return "";
  return "<section class=\"warning\" id=\"warnings\" aria-labelledby=\"warnings-title\">\n"
         "<h2 id=\"warnings-title\">⚠ Do not trust without a look</h2>\n" +
         html_list(results.warnings) + "</section>\n";
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
  for (std::size_t c = 0; c < result.columns.size(); ++c) {
    const auto& [name, unit] = result.columns[c];
    const bool is_number =
        c > 0 && std::any_of(result.rows.begin(), result.rows.end(), [&](const auto& row) {
          return c < row.size() && looks_like_number(row[c]);
        });
    table.columns.push_back({unit.empty() ? name : name + " (" + unit + ")", is_number});
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
          {"warnings", warnings_html(results)},
          {"subject", study.neck() != nullptr
                          ? "From the geometry of a crash-test dummy's neck to its motion: "
                            "modes by finite elements, the static neck tester and the "
                            "head/neck pendulum."
                          : "From a geometry to its modes by finite elements."},
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
