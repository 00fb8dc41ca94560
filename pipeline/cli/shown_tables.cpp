// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/cli/shown_tables.h"

#include <algorithm>
#include <array>
#include <span>
#include <string_view>

#include <fmt/core.h>

#include "pipeline/process/wrapped_text.h"

namespace flexneck::pipeline {

namespace {

/// A column of a table, the first of that name, and its title in the short table.
struct ShortColumn {
  std::string_view name;
  std::string_view shown;
};

constexpr std::array<ShortColumn, 6> kStatic = {{{"case", "case"},
                                                 {"rotation", "rotation"},
                                                 {"deflection", "deflection"},
                                                 {"base moment", "base moment"},
                                                 {"initial", "initial"},
                                                 {"final", "final"}}};
constexpr std::array<ShortColumn, 7> kPeaks = {{{"case", "case"},
                                                {"head rotation", "head"},
                                                {"at", "at"},
                                                {"neck rotation", "neck"},
                                                {"head acceleration", "head"},
                                                {"base moment", "base"},
                                                {"occipital moment", "occipital"}}};

constexpr std::array<ShortColumn, 6> kVerdicts = {{{"regulation", "regulation"},
                                                   {"case", "case"},
                                                   {"verdict", ""},
                                                   {"inside", "inside"},
                                                   {"furthest", "furthest"},
                                                   {"off centre", "off"}}};

constexpr std::array<ShortColumn, 5> kMeasured = {{{"test", "test"},
                                                   {"case", "case"},
                                                   {"channel", "channel"},
                                                   {"ISO/TS 18571", "ISO/TS 18571"},
                                                   {"CORA", "CORA"}}};
constexpr std::array<ShortColumn, 7> kLimits = {{{"test", "test"},
                                                 {"channel", "channel"},
                                                 {"figure", "figure"},
                                                 {"value", "value"},
                                                 {"limits", "limits"},
                                                 {"unit", ""},
                                                 {"verdict", ""}}};

/// A table that is printed in short form; other tables need --verbose.
struct ShortTable {
  std::string_view name;
  std::span<const ShortColumn> columns;
};
constexpr std::array<ShortTable, 5> kShortTables = {{{"static tests", kStatic},
                                                     {"peaks", kPeaks},
                                                     {"verdicts", kVerdicts},
                                                     {"measured curves", kMeasured},
                                                     {"measured limits", kLimits}}};

/// True if the case is a variant, which gets a line only with --verbose.
bool is_variant(const Study& study, const std::string& name) {
  return std::any_of(study.cases.begin(), study.cases.end(), [&](const CaseSection& each) {
    return each.name == name && !each.variant_of.empty();
  });
}

ResultTable shortened(const Study& study, const ResultTable& table,
                      std::span<const ShortColumn> columns) {
  ResultTable result{table.name, table.title, {}, {}, {}};
  std::vector<std::size_t> places;
  for (const ShortColumn& shown : columns) {
    const auto found = std::find_if(table.columns.begin(), table.columns.end(),
                                    [&](const auto& column) { return column.name == shown.name; });
    if (found == table.columns.end()) continue;
    places.push_back(static_cast<std::size_t>(found - table.columns.begin()));
    result.columns.push_back({std::string(shown.shown), found->unit});
  }
  for (const std::vector<std::string>& row : table.rows) {
    if (table.columns.front().name == "case" && is_variant(study, row.front())) continue;
    std::vector<std::string>& cells = result.rows.emplace_back();
    for (const std::size_t place : places) cells.push_back(row[place]);
  }
  return result;
}

}  // namespace

void show_tables(const CommandInput& input, const std::vector<ResultTable>& tables) {
  for (const ResultTable& table : tables) {
    input.console.table("\n" + printed(table));
    if (input.console.is_verbose()) continue;
    for (const ShortTable& shown : kShortTables)
      if (shown.name == table.name)
        input.console.result("\n" + printed(shortened(input.study, table, shown.columns)));
  }
}

void show_verification(const CommandInput& input, const VerificationTable& table) {
  VerificationTable verdicts = table;
  std::erase_if(verdicts.rows, [](const VerificationRow& row) {
    return row.status == VerificationRow::Status::compared;
  });
  const std::size_t others = table.rows.size() - verdicts.rows.size();
  input.console.result(printed(input.console.is_verbose() ? table : verdicts));
  if (std::any_of(table.rows.begin(), table.rows.end(), [](const VerificationRow& row) {
        return row.status == VerificationRow::Status::unjudged;
      })) {
    std::string why = wrapped("no figure has a verdict: " + why_unjudged(input.study, table), "  ");
    why.pop_back();  // result() ends the line
    input.console.result(why);
  }
  if (others > 0 && !input.console.is_verbose())
    input.console.result(fmt::format("  and {} figures without a verdict (--verbose)", others));
  if (!table.passed()) input.console.error("a verification failed; see the table above");
}

}  // namespace flexneck::pipeline
