// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/results/plotting/curve_figure.h"

#include <algorithm>
#include <array>

#include <fmt/core.h>

namespace flexneck::pipeline {

namespace {

/// Line style of a curve: distinguishable in colour without colour vision, and in grey by dashes;
/// further curves are drawn wider.
std::string style_of(std::size_t curve) {
  constexpr std::array<const char*, 4> kStyles = {"lc rgb '#0072b2'", "dt (8,4) lc rgb '#d55e00'",
                                                  "dt (2,4) lc rgb '#009e73'",
                                                  "dt (10,3,2,3) lc rgb '#7f7f7f'"};
  const std::size_t round = curve / kStyles.size();
  return fmt::format("lw {:.1f} {}", 2.2 + 2.0 * static_cast<double>(round),
                     kStyles[curve % kStyles.size()]);
}

bool have_same_x(const std::vector<FigureCurve>& curves) {
  return std::all_of(curves.begin(), curves.end(), [&](const FigureCurve& curve) {
    return curve.x.size() == curves.front().x.size() && curve.x == curves.front().x;
  });
}

/// Heading in quotes, since titles may contain commas.
std::string heading(const std::string& title, const std::string& label) {
  return "\"" + (title.empty() ? label : title + ": " + label) + "\"";
}

std::string csv_of(const CurvePlot& plot, bool shares_x) {
  const std::vector<FigureCurve>& curves = plot.curves;
  std::string csv = shares_x ? heading("", plot.x_label) : "";
  Eigen::Index rows = 0;
  for (const FigureCurve& curve : curves) {
    if (!shares_x) csv += (csv.empty() ? "" : ",") + heading(curve.title, plot.x_label);
    csv += "," + heading(curve.title, plot.y_label);
    rows = std::max(rows, curve.x.size());
  }
  for (Eigen::Index k = 0; k < rows; ++k) {
    csv += "\n";
    if (shares_x) csv += fmt::format("{:.9g}", curves.front().x[k]);
    for (std::size_t c = 0; c < curves.size(); ++c) {
      const bool is_there = k < curves[c].x.size();
      if (!shares_x) {
        csv += c > 0 ? "," : "";
        csv += is_there ? fmt::format("{:.9g}", curves[c].x[k]) : "";
      }
      csv += "," + (is_there ? fmt::format("{:.9g}", curves[c].y[k]) : "");
    }
  }
  return csv + "\n";
}

/// Upper end of the y axis, which includes the bands.
std::string top_of(const std::vector<FigureBand>& bands) {
  double top = 0;
  for (const FigureBand& band : bands) top = std::max(top, band.high);
  return top > 0 ? fmt::format("{} < *", 1.03 * top) : "*";
}

std::string bands_script(const std::vector<FigureBand>& bands) {
  std::string script;
  for (const FigureBand& band : bands) {
    const bool is_line = band.low == band.high;
    script +=
        is_line
            ? fmt::format("set arrow from {0},{2} to {1},{2} nohead front lw 6 lc rgb '#8a8a8a'\n",
                          band.left, band.right, band.low)
            : fmt::format(
                  "set object rectangle from {},{} to {},{} behind fc rgb '#d9d9d9' fs "
                  "solid border rgb '#8a8a8a'\n",
                  band.left, band.low, band.right, band.high);
    script +=
        fmt::format("set label {} at {},{} offset 1,{} left textcolor rgb '#555555' font ',11'\n",
                    gnuplot_text(band.label), band.right, band.high, is_line ? 0.7 : 0);
  }
  return script;
}

}  // namespace

void draw_curves(const CurvePlot& plot, Figure& figure) {
  const bool shares_x = have_same_x(plot.curves);
  figure.csv = csv_of(plot, shares_x);
  figure.script = script_head(figure, 760, 500) +
                  fmt::format(
                      "set xlabel {}\nset ylabel {}\nset grid lc rgb '#dddddd' lt 1\n"
                      "set border 3 lc rgb '#444444'\nset tics nomirror\n"
                      "set xzeroaxis lt 1 lc rgb '#444444'\n"
                      "set key below left maxcols 2 noenhanced\n"
                      "set xrange [0:*]\nset yrange [*:{}]\n"
                      "set label {} at graph 0.99,0.035 right textcolor rgb '#777777' font ',11'\n",
                      gnuplot_text(plot.x_label), gnuplot_text(plot.y_label), top_of(plot.bands),
                      gnuplot_text(plot.note)) +
                  bands_script(plot.bands) + "plot";
  for (std::size_t c = 0; c < plot.curves.size(); ++c) {
    const std::size_t x = shares_x ? 1 : 2 * c + 1;
    const std::size_t y = shares_x ? c + 2 : 2 * c + 2;
    figure.script +=
        fmt::format("{} '{}.csv' skip 1 using {}:{} with lines {} title {}", c > 0 ? "," : "",
                    stem_of(figure), x, y, style_of(c), gnuplot_text(plot.curves[c].title));
  }
  figure.script += "\n";
}

}  // namespace flexneck::pipeline
