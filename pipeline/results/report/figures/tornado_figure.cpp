// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/results/report/figures/tornado_figure.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>

#include <fmt/core.h>

#include "pipeline/results/tables/sensitivity_tables.h"

namespace flexneck::pipeline {

namespace {

constexpr std::size_t kFrequencies = 6;  ///< panels with frequencies only
constexpr std::size_t kBars = 8;         ///< number of bars of a panel, the longest ones
constexpr int kPanelWidth = 400;
constexpr int kPanelHeight = 240;
constexpr int kPanelsAcross = 2;

struct Bar {
  std::string input;
  double relative = 0;
};

struct Panel {
  std::string quantity;
  std::vector<Bar> bars;
};

/// Number in a cell of a table; 0 if there is none.
double number_of(const std::string& cell) {
  const char* const first = cell.data() + (cell.starts_with('+') ? 1 : 0);
  double value = 0;
  std::from_chars(first, cell.data() + cell.size(), value);
  return value;
}

/// Panel with the longest bars of a column.
Panel panel_of(const ResultTable& table, std::size_t column) {
  Panel panel{table.columns[column].name, {}};
  for (const std::vector<std::string>& row : table.rows) {
    const double relative = number_of(row[column]);
    if (relative != 0) panel.bars.push_back({row.front(), relative});
  }
  std::stable_sort(panel.bars.begin(), panel.bars.end(), [](const Bar& a, const Bar& b) {
    return std::abs(a.relative) > std::abs(b.relative);
  });
  panel.bars.resize(std::min(panel.bars.size(), kBars));
  return panel;
}

/// Appends the first accepted columns of a table as panels.
void add_panels(const Results& results, std::size_t table, std::size_t count,
                const std::function<bool(const std::string&)>& is_wanted,
                std::vector<Panel>& panels) {
  for (const ResultTable& each : results.tables) {
    if (each.name != relative_table_name(table)) continue;
    for (std::size_t c = 1; c < each.columns.size() && count > 0; ++c) {
      if (!is_wanted(each.columns[c].name)) continue;
      panels.push_back(panel_of(each, c));
      --count;
    }
  }
}

std::vector<Panel> panels_of(const Results& results) {
  const auto is_gradient = [](const std::string& name) {
    return !name.ends_with(", directional") && !name.ends_with(", by symmetry class");
  };
  std::vector<Panel> panels;
  add_panels(results, 0, kFrequencies, is_gradient, panels);
  add_panels(results, 1, 1, is_gradient, panels);
  const auto begins = [](const char* text) {
    return [text](const std::string& name) { return name.starts_with(text); };
  };
  add_panels(results, 2, 1, begins("My/ry"), panels);
  add_panels(results, 2, 1, begins("mass"), panels);
  return panels;
}

std::string csv_of(const std::vector<Panel>& panels) {
  std::string csv = "quantity,input,d ln(quantity) / d ln(input)\n";
  for (std::size_t k = 0; k < panels.size(); ++k) {
    if (k > 0) csv += "\n\n";
    for (const Bar& bar : panels[k].bars)
      csv += fmt::format("\"{}\",{},{:.4f}\n", panels[k].quantity, bar.input, bar.relative);
  }
  return csv;
}

/// Script of a panel: bars below one another, each beside the key of its input.
std::string panel_script(const Panel& panel, std::size_t index, double reach,
                         const std::string& file) {
  std::string script =
      fmt::format("unset label\nset title {} font ',10'\n", gnuplot_text(panel.quantity));
  for (std::size_t k = 0; k < panel.bars.size(); ++k) {
    std::string key = panel.bars[k].input;
    if (key.starts_with("geometry.")) key.erase(0, std::string("geometry.").size());
    script += fmt::format(
        "set label {} at graph -0.02,first {} right font ',10'\n"
        "set label '{:+.2f}' at graph 1.01,first {} left font ',10'\n",
        gnuplot_text(key), -static_cast<double>(k), panel.bars[k].relative,
        -static_cast<double>(k));
  }
  return script + fmt::format(
                      "set xrange [{0:.6g}:{1:.6g}]\nset yrange [{2}:0.7]\n"
                      "plot '{3}' skip 1 index {4} using ($3/2):(-$0):(abs($3)/2):(0.38):"
                      "($3 < 0 ? 0xd55e00 : 0x0072b2) with boxxyerror lc rgb variable notitle\n",
                      -reach, reach, -static_cast<double>(kBars) + 0.3, file, index);
}

}  // namespace

Figure tornado_figure(const Results& results) {
  Figure figure{.caption = "Effect of a change of each input by 1 %, in per cent",
                .name = "tornado"};
  const std::vector<Panel> panels = panels_of(results);
  if (panels.empty()) {
    figure.missing = "sensitivities.json, which 'flexneck modes --sensitivity' creates";
    return figure;
  }
  double reach = 0;
  for (const Panel& panel : panels)
    for (const Bar& bar : panel.bars) reach = std::max(reach, std::abs(bar.relative));
  figure.remark = fmt::format(
      "d ln(quantity) / d ln(input), the {} largest of each quantity, all to the same scale.",
      kBars);
  figure.csv = csv_of(panels);
  const int rows = (static_cast<int>(panels.size()) + kPanelsAcross - 1) / kPanelsAcross;
  figure.script =
      script_head(figure, kPanelsAcross * kPanelWidth, rows * kPanelHeight) +
      fmt::format(
          "set multiplot layout {},{} margins 0.24,0.94,0.04,0.96 spacing 0.3,0.06\n"
          "unset key\nunset ytics\nset border 1 lc rgb '#444444'\nset xtics nomirror font ',10'\n"
          "set grid xtics lc rgb '#dddddd' lt 1\nset style fill solid 1 noborder\n"
          "set arrow from 0,graph 0 to 0,graph 1 nohead front lc rgb '#444444'\n",
          rows, kPanelsAcross);
  for (std::size_t k = 0; k < panels.size(); ++k)
    figure.script += panel_script(panels[k], k, 1.05 * reach, stem_of(figure) + ".csv");
  figure.script += "unset multiplot\n";
  return figure;
}

}  // namespace flexneck::pipeline
