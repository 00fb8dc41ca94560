// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/results/tables/sensitivity_tables.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/core.h>

#include "pipeline/process/text_table.h"
#include "pipeline/process/wrapped_text.h"

namespace flexneck::pipeline {

namespace {

using fe_modal::Quantity;
using fe_modal::QuantityKind;
using fe_modal::Sensitivities;

bool is_frequency(const Quantity& quantity) {
  return quantity.kind != QuantityKind::mass && quantity.kind != QuantityKind::static_stiffness;
}

/// Quantities that have columns in a table of relative derivatives.
struct Selection {
  const char* name;
  const char* title;
  bool (*takes)(const Quantity&);
};
constexpr std::array<Selection, 3> kSelections = {
    {{"relative sensitivities", "Frequencies",
      [](const Quantity& each) { return is_frequency(each) && !each.is_attached; }},
     {"relative sensitivities, attached", "Frequencies with a body attached",
      [](const Quantity& each) { return is_frequency(each) && each.is_attached; }},
     {"relative sensitivities, stiffness and mass", "Static stiffness and mass",
      [](const Quantity& each) { return !is_frequency(each); }}}};

/// Number with a given count of digits behind the point; zero without a sign.
std::string relative_text(double value, int digits) {
  const bool is_zero = std::abs(value) < 0.5 * std::pow(10.0, -digits);
  return is_zero ? fmt::format("{:.{}f}", 0.0, digits) : fmt::format("{:+.{}f}", value, digits);
}

std::string heading(const Quantity& quantity) {
  switch (quantity.kind) {
    case QuantityKind::mean_frequency:
      return "mean of " + quantity.name;
    case QuantityKind::directional:
      return quantity.name + ", directional";
    case QuantityKind::symmetry_class:
      return quantity.name + ", by symmetry class";
    default:
      return quantity.name;
  }
}

ResultTable relative_table(const Selection& selection, const Sensitivities& found) {
  ResultTable table{
      selection.name,
      std::string(selection.title) + ": d ln(quantity) / d ln(input), per cent for one per cent",
      {{"input", ""}},
      {},
      {}};
  const Eigen::MatrixXd relative = found.relative();
  for (const fe_modal::DesignParameter& parameter : found.parameters)
    table.rows.push_back({parameter.name});
  for (std::size_t q = 0; q < found.quantities.size(); ++q) {
    if (!selection.takes(found.quantities[q])) continue;
    table.columns.push_back({heading(found.quantities[q]), ""});
    for (std::size_t p = 0; p < found.parameters.size(); ++p) {
      table.rows[p].push_back(
          relative_text(relative(static_cast<Eigen::Index>(q), static_cast<Eigen::Index>(p)), 4));
    }
  }
  return table;
}

/// Unit of a derivative such as "Hz/m"; by a pure number the quantity's own unit.
std::string quotient(const std::string& unit, const std::string& by) {
  if (by == "1") return unit;
  return unit + "/" + (by.find('/') == std::string::npos ? by : "(" + by + ")");
}

ResultTable whole_table(const Sensitivities& found) {
  ResultTable table{
      kSensitivityTable, "Derivatives of all quantities by all inputs, SI", {}, {}, {}};
  for (const char* const column :
       {"quantity", "kind", "attached", "value", "unit", "input", "input value", "input unit",
        "derivative", "derivative unit", "relative"}) {
    table.columns.push_back({column, ""});
  }
  const Eigen::MatrixXd relative = found.relative();
  for (std::size_t q = 0; q < found.quantities.size(); ++q) {
    const Quantity& quantity = found.quantities[q];
    for (std::size_t p = 0; p < found.parameters.size(); ++p) {
      const fe_modal::DesignParameter& input = found.parameters[p];
      const auto at = std::pair(static_cast<Eigen::Index>(q), static_cast<Eigen::Index>(p));
      table.rows.push_back({quantity.name, std::string(name_of(quantity.kind)),
                            quantity.is_attached ? "yes" : "no",
                            fmt::format("{:.10g}", quantity.value), quantity.unit, input.name,
                            fmt::format("{:.10g}", input.value), input.unit,
                            fmt::format("{:.8g}", found.derivatives(at.first, at.second)),
                            quotient(quantity.unit, input.unit),
                            fmt::format("{:.8g}", relative(at.first, at.second))});
    }
  }
  return table;
}

/// A quantity in the short table.
struct ShortColumn {
  std::string title;
  std::size_t quantity;
};

/// Columns of the short table: the first frequencies that have room, the first with a body
/// attached, the mass.
std::vector<ShortColumn> short_columns(const Sensitivities& found) {
  constexpr std::size_t kWidth = 8;  // two blanks and six digits
  std::size_t widest = 0;
  for (const fe_modal::DesignParameter& parameter : found.parameters)
    widest = std::max(widest, parameter.name.size());
  const std::size_t room = kConsoleColumns > widest + 2 ? kConsoleColumns - widest - 2 : 0;
  const std::size_t alone = std::max<std::size_t>(room / kWidth, 3) - 2;
  bool needs_attached = true;
  std::vector<ShortColumn> columns;
  std::vector<ShortColumn> last;
  for (std::size_t q = 0; q < found.quantities.size(); ++q) {
    const Quantity& quantity = found.quantities[q];
    const bool has_gradient =
        quantity.kind == QuantityKind::frequency || quantity.kind == QuantityKind::mean_frequency;
    if (quantity.kind == QuantityKind::mass) last.push_back({"mass", q});
    if (!has_gradient) continue;
    if (!quantity.is_attached && columns.size() < alone)
      columns.push_back({fmt::format("f{}", columns.size() + 1), q});
    if (quantity.is_attached && needs_attached) last.push_back({"loaded", q});
    needs_attached = needs_attached && !quantity.is_attached;
  }
  columns.insert(columns.end(), last.begin(), last.end());
  return columns;
}

}  // namespace

const char* relative_table_name(std::size_t which) { return kSelections.at(which).name; }

bool is_of_sensitivities(const ResultTable& table) {
  return table.name == kSensitivityTable ||
         std::any_of(kSelections.begin(), kSelections.end(),
                     [&](const Selection& each) { return table.name == each.name; });
}

std::vector<ResultTable> sensitivity_tables(const Sensitivities& found,
                                            const std::vector<std::string>& notes) {
  std::vector<ResultTable> tables;
  for (const Selection& selection : kSelections) {
    ResultTable table = relative_table(selection, found);
    if (table.columns.size() > 1) tables.push_back(std::move(table));
  }
  tables.front().notes = found.notes;
  tables.front().notes.insert(tables.front().notes.end(), notes.begin(), notes.end());
  tables.push_back(whole_table(found));
  return tables;
}

std::string short_sensitivities(const Sensitivities& found) {
  std::vector<std::vector<std::string>> rows = {{"input"}};
  std::string legend;
  for (const fe_modal::DesignParameter& parameter : found.parameters)
    rows.push_back({parameter.name});
  const Eigen::MatrixXd relative = found.relative();
  for (const ShortColumn& column : short_columns(found)) {
    const Quantity& quantity = found.quantities[column.quantity];
    rows.front().push_back(column.title);
    if (is_frequency(quantity)) {
      legend +=
          fmt::format("\n  {}: {}, {:.3f} Hz", column.title, heading(quantity), quantity.value);
    }
    for (std::size_t p = 0; p < found.parameters.size(); ++p) {
      rows[p + 1].push_back(relative_text(
          relative(static_cast<Eigen::Index>(column.quantity), static_cast<Eigen::Index>(p)), 3));
    }
  }
  return "Sensitivities: d ln(quantity) / d ln(input)\n" + text_table(rows) + legend;
}

}  // namespace flexneck::pipeline
