// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/results/report/comparison.h"

#include <algorithm>
#include <functional>
#include <map>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "geometry/foundation/ascii.h"
#include "geometry/foundation/output_file.h"
#include "pipeline/results/plotting/embedding.h"
#include "pipeline/results/report/curves.h"
#include "pipeline/results/report/html_table.h"
#include "pipeline/results/report/neck_scene.h"
#include "pipeline/results/report/page_sections.h"
#include "pipeline/results/report/pictures_html.h"
#include "pipeline/results/report/web_library.h"
#include "pipeline/results/tables/sensitivity_tables.h"

namespace flexneck::pipeline {

using Json = nlohmann::ordered_json;

namespace {

constexpr const char* kNone = "-";

/// Rows by their first cell, in order of appearance, with one cell for each study.
class SideBySide {
 public:
  explicit SideBySide(std::size_t studies) : studies_(studies) {}

  void put(const std::string& head, std::size_t study, const std::string& cell) {
    const auto [place, is_new] = places_.try_emplace(head, rows_.size());
    if (is_new) {
      rows_.emplace_back(studies_ + 1, kNone);
      rows_.back().front() = head;
    }
    rows_[place->second][study + 1] = cell;
  }
  std::vector<std::vector<std::string>> rows() && { return std::move(rows_); }

 private:
  std::size_t studies_;
  std::map<std::string, std::size_t> places_;
  std::vector<std::vector<std::string>> rows_;
};

ResultTable table_of(const std::string& name, const std::string& title, const std::string& head,
                     const std::vector<ComparedStudy>& studies, SideBySide cells) {
  ResultTable table{name, title, {{head, ""}}, std::move(cells).rows(), {}};
  for (const ComparedStudy& study : studies) table.columns.push_back({study.label, ""});
  return table;
}

/// Inputs that differ. Those of all studies come first: the others are mostly keys of cases that
/// one study lacks.
ResultTable differing_inputs(const std::vector<ComparedStudy>& studies) {
  SideBySide cells(studies.size());
  for (std::size_t s = 0; s < studies.size(); ++s)
    for (const ResultFile& file : studies[s].results.files)
      for (const Parameter& parameter : file.provenance.parameters)
        cells.put(parameter.key, s, parameter.value);
  ResultTable table = table_of("inputs", "Inputs that differ", "input", studies, std::move(cells));
  std::erase_if(table.rows, [](const std::vector<std::string>& row) {
    return std::all_of(row.begin() + 2, row.end(),
                       [&](const std::string& cell) { return cell == row[1]; });
  });
  std::stable_partition(table.rows.begin(), table.rows.end(),
                        [](const std::vector<std::string>& row) {
                          return std::find(row.begin(), row.end(), kNone) == row.end();
                        });
  return table;
}

/// True if each study has a quantity at most once.
bool is_unique(const std::string& quantity, const std::vector<ComparedStudy>& studies) {
  return std::all_of(studies.begin(), studies.end(), [&](const ComparedStudy& study) {
    if (!study.results.verification) return true;
    const std::vector<VerificationRow>& rows = study.results.verification->rows;
    return std::count_if(rows.begin(), rows.end(),
                         [&](const VerificationRow& row) { return row.quantity == quantity; }) <= 1;
  });
}

/// Verifications by quantity: another study may find the same quantity in another detail, such as
/// the first bending frequency in the lateral mode. The detail distinguishes rows only if a
/// quantity has several.
ResultTable verifications(const std::vector<ComparedStudy>& studies) {
  SideBySide cells(studies.size());
  for (std::size_t s = 0; s < studies.size(); ++s) {
    if (!studies[s].results.verification) continue;
    for (const VerificationRow& row : studies[s].results.verification->rows) {
      const std::string unit = row.unit == "1" ? "" : " " + row.unit;
      const std::string error =
          row.error_percent ? fmt::format(" ({:+.2f} %)", *row.error_percent) : "";
      const std::string published =
          "; " + studies[s].results.verification->reference_origins + " " + row.reference + unit;
      const std::string detail = ", " + row.detail;
      if (is_unique(row.quantity, studies))
        cells.put(row.quantity + published, s, row.value + error + detail);
      else
        cells.put(row.quantity + detail + published, s, row.value + error);
    }
  }
  return table_of("verification", "Computed, and its difference from the reference", "quantity",
                  studies, std::move(cells));
}

ResultTable frequencies(const std::vector<ComparedStudy>& studies) {
  SideBySide cells(studies.size());
  for (std::size_t s = 0; s < studies.size(); ++s) {
    if (!studies[s].results.modes) continue;
    const fe_modal::ModalBody& body = *studies[s].results.modes;
    for (std::size_t k = 0; k < body.modes.size(); ++k)
      cells.put(body.modes[k].name, s,
                fmt::format("{:.3f}", body.frequencies_Hz[static_cast<Eigen::Index>(k)]));
  }
  return table_of("modes", "Frequencies of the modes, Hz", "mode", studies, std::move(cells));
}

const ResultTable* find_table(const Results& results, const std::string& name) {
  const auto found = std::find_if(results.tables.begin(), results.tables.end(),
                                  [&](const ResultTable& table) { return table.name == name; });
  return found == results.tables.end() ? nullptr : &*found;
}

bool has_same_columns(const ResultTable& one, const ResultTable& other) {
  return std::equal(
      one.columns.begin(), one.columns.end(), other.columns.begin(), other.columns.end(),
      [](const auto& a, const auto& b) { return a.name == b.name && a.unit == b.unit; });
}

/// Rows of a table from all studies, those with the same first cell next to one another.
ResultTable merged(const ResultTable& first, const std::vector<ComparedStudy>& studies) {
  ResultTable table{first.name, first.title, first.columns, {}, first.notes};
  table.columns.insert(table.columns.begin() + 1, {"study", ""});
  std::vector<std::string> heads;
  std::multimap<std::string, std::vector<std::string>> rows;
  for (const ComparedStudy& study : studies) {
    const ResultTable* const other = find_table(study.results, first.name);
    if (other == nullptr || !has_same_columns(first, *other)) continue;
    for (std::vector<std::string> row : other->rows) {
      if (rows.find(row.front()) == rows.end()) heads.push_back(row.front());
      row.insert(row.begin() + 1, study.label);
      rows.emplace(row.front(), row);
    }
  }
  for (const std::string& head : heads) {
    const auto [begin, end] = rows.equal_range(head);
    for (auto row = begin; row != end; ++row) table.rows.push_back(row->second);
  }
  return table;
}

/// First cells of a folder's tables: its cases in the order of its study, which is not available.
std::vector<std::string> cases_in_order(const Results& results) {
  std::vector<std::string> names;
  for (const ResultTable& table : results.tables)
    for (const std::vector<std::string>& row : table.rows) names.push_back(row.front());
  return names;
}

/// All runs in the order of the first study; runs of other studies become variants of its cases.
Results all_runs(const std::vector<ComparedStudy>& studies) {
  const std::vector<std::string> order = cases_in_order(studies.front().results);
  Results all;
  for (const ComparedStudy& study : studies) {
    std::vector<Experiment> runs = study.results.experiments;
    std::stable_sort(runs.begin(), runs.end(), [&](const Experiment& a, const Experiment& b) {
      const auto place = [&](const Experiment& run) {
        return std::pair(run.kind, std::find(order.begin(), order.end(), run.name));
      };
      return place(a) < place(b);
    });
    for (Experiment& run : runs) {
      if (&study != &studies.front()) run.name += "-" + study.label;
      all.experiments.push_back(std::move(run));
    }
  }
  return all;
}

/// Number of points shown of a run if several studies share a page, to keep the page small.
Eigen::Index share_of(Eigen::Index alone, const std::vector<ComparedStudy>& studies) {
  constexpr Eigen::Index kLeast = 100;
  return std::max(kLeast, alone / static_cast<Eigen::Index>(studies.size()));
}

std::string warnings_of(const std::vector<ComparedStudy>& studies) {
  std::vector<std::string> warnings;
  for (const ComparedStudy& study : studies)
    for (const std::string& warning : study.results.all_warnings())
      warnings.push_back(study.label + ": " + warning);
  return html_list(warnings);
}

}  // namespace

std::vector<ResultTable> compared_tables(const std::vector<ComparedStudy>& studies) {
  std::vector<ResultTable> tables = {differing_inputs(studies), verifications(studies),
                                     frequencies(studies)};
  for (const ResultTable& table : studies.front().results.tables) {
    // The tables of relative sensitivities are for readers.
    if (table.name == kSensitivityTable) continue;
    const bool is_shared =
        std::any_of(studies.begin() + 1, studies.end(), [&](const ComparedStudy& study) {
          const ResultTable* const other = find_table(study.results, table.name);
          return other != nullptr && has_same_columns(table, *other);
        });
    if (is_shared) tables.push_back(merged(table, studies));
  }
  return tables;
}

void write_comparison(const std::filesystem::path& path,
                      const std::vector<ComparedStudy>& studies) {
  std::string names;
  Json scenes = Json::array();
  std::string pictures;
  for (const ComparedStudy& study : studies) {
    names += (names.empty() ? "" : ", ") + study.label;
    Json scene = scene_of(study.results, study.study, share_of(kMaxFrames, studies));
    if (scene.is_null()) continue;
    scenes.push_back({{"label", study.label}, {"scene", std::move(scene)}});
    pictures += mesh_picture_html(study.folder, study.label);
  }
  Json curves = curves_of(all_runs(studies), {}, share_of(kMaxSamples, studies));
  if (!curves.is_null())
    for (const ComparedStudy& study : studies) curves["folders"].push_back(study.label);
  std::map<std::string, std::string> texts = {{"head", page_head(html_text(names))},
                                              {"units", page_part("units.html")},
                                              {"studies", html_text(names)}};
  if (!scenes.empty())
    add_section("view", "In motion", "Modes and motion",
                "<div class=\"viewer\">\n" + page_part("scene.html") + "</div>\n<div hidden>\n" +
                    pictures + "</div>\n",
                texts);
  add_section("warnings", "Warnings", kWarningsTitle, warnings_of(studies), texts);
  std::vector<ResultTable> tables = compared_tables(studies);
  // Differences come before all curves.
  const auto add_table = [&](const ResultTable& table) {
    std::string id = "table-" + table.name;
    std::replace_if(id.begin(), id.end(), std::not_fn(is_letter_or_digit), '-');
    std::string link = table.name;
    if (!link.empty()) link.front() = upper_case(link.front());
    add_section(id, html_text(link), html_text(table.title),
                html_of(html_table_of(table)) + html_list(table.notes), texts);
  };
  const std::size_t first = std::min<std::size_t>(3, tables.size());
  std::for_each_n(tables.begin(), first, add_table);
  if (!curves.is_null()) add_section("curves", "Curves", "Curves", page_part("plots.html"), texts);
  std::for_each(tables.begin() + static_cast<std::ptrdiff_t>(first), tables.end(), add_table);
  texts["data"] = page_data(scenes, curves);
  texts["scripts"] = page_scripts(!scenes.empty(), !curves.is_null());
  write_text(path, filled(page_part("comparison.html"), texts), Durability::none);
}

}  // namespace flexneck::pipeline
