// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/results/report/sweep_pictures.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/core.h>

#include "geometry/foundation/input_file.h"
#include "geometry/foundation/output_file.h"
#include "geometry/foundation/temporary_folder.h"
#include "pipeline/results/plotting/figure.h"
#include "pipeline/results/plotting/gnuplot.h"

namespace flexneck::pipeline {

namespace fs = std::filesystem;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr Index kMaxPoints = 2000;
constexpr int kPanels = 3;  ///< number of panels side by side

VectorXd ranks_of(const VectorXd& values) {
  std::vector<Index> order(static_cast<std::size_t>(values.size()));
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](Index a, Index b) { return values[a] < values[b]; });
  VectorXd ranks(values.size());
  for (std::size_t first = 0; first < order.size();) {
    std::size_t end = first;
    while (end < order.size() && values[order[end]] == values[order[first]]) ++end;
    for (std::size_t k = first; k < end; ++k)
      ranks[order[k]] = static_cast<double>(first + end - 1) / 2;
    first = end;
  }
  return ranks;
}

std::string label_of(const std::string& name, const std::string& unit) {
  return gnuplot_text(unit == "1" ? name : name + " [" + unit + "]");
}

/// Numbers of the rows shown, spaced evenly over all rows.
std::vector<std::uint64_t> shown_rows(std::uint64_t count) {
  const std::uint64_t step = (count + kMaxPoints - 1) / kMaxPoints;
  std::vector<std::uint64_t> rows;
  for (std::uint64_t row = 0; row < count; row += step) rows.push_back(row);
  return rows;
}

/// Pictures being drawn: one script for all.
class Drawing {
 public:
  explicit Drawing(const SweepPictures& of) : of_(of), rows_(shown_rows(of.sweep.count())) {
    inputs_.resize(static_cast<Index>(of.sweep.units().size()), static_cast<Index>(rows_.size()));
    for (std::size_t k = 0; k < rows_.size(); ++k)
      inputs_.col(static_cast<Index>(k)) = of.sweep.numbers(rows_[k]);
  }

  void add_scatter(std::size_t output) {
    const std::string stem = "sweep-scatter-" + file_part_of(of_.outputs[output].name);
    VectorXd shown(static_cast<Index>(rows_.size()));
    for (std::size_t k = 0; k < rows_.size(); ++k)
      shown[static_cast<Index>(k)] =
          of_.table.figures(static_cast<Index>(output), static_cast<Index>(rows_[k]));
    std::string csv;
    for (Index k = 0; k < shown.size(); ++k) {
      if (std::isnan(shown[k])) continue;
      for (Index i = 0; i < inputs_.rows(); ++i) csv += fmt::format("{:.9g},", inputs_(i, k));
      csv += fmt::format("{:.9g}\n", shown[k]);
    }
    if (csv.empty()) return;
    const auto panels = static_cast<int>(inputs_.rows());
    const int lines = (panels + kPanels - 1) / kPanels;
    begin(stem, csv, 300 * std::min(panels, kPanels), 280 * lines);
    script_ +=
        fmt::format("set multiplot layout {},{}\nset ylabel {}\n", lines, std::min(panels, kPanels),
                    label_of(of_.outputs[output].name, of_.outputs[output].unit));
    for (int i = 0; i < panels; ++i)
      script_ += fmt::format(
          "set xlabel {}\nplot '{}.csv' using {}:{} with points pt 7 ps 0.3 lc rgb '#0072b2' "
          "notitle\n",
          label_of(of_.sweep.section().parameters[static_cast<std::size_t>(i)].name,
                   of_.sweep.units()[static_cast<std::size_t>(i)]),
          stem, i + 1, panels + 1);
    script_ += "unset multiplot\n";
  }

  void add_tornado(std::size_t output) {
    const std::vector<Bar> bars = bars_of(output);
    if (bars.empty()) return;
    const std::string stem = "sweep-tornado-" + file_part_of(of_.outputs[output].name);
    std::string csv;
    std::string names;
    for (std::size_t k = 0; k < bars.size(); ++k) {
      const Estimate& share = bars[k].share;
      csv += fmt::format("{:.9g},{:.9g},{:.9g},{}\n", share.value, share.interval.low,
                         share.interval.high, k);
      names += fmt::format("{}{} {}", k > 0 ? ", " : "", gnuplot_tic(bars[k].parameter), k);
    }
    begin(stem, csv, 640, 120 + 40 * static_cast<int>(bars.size()));
    script_ += fmt::format(
        "set xlabel {}\nset yrange [-0.7:{}]\nset ytics ({}) noenhanced\nset yzeroaxis lt 1 lc rgb "
        "'#444444'\n"
        "set style fill solid 0.7\n"
        "plot '{}.csv' using (0):4:(0):1:($4-0.3):($4+0.3) with boxxyerror lc rgb '#0072b2' "
        "notitle, '' using 1:4:2:3 with xerrorbars pt 0 lw 1.5 lc rgb '#444444' notitle\n",
        gnuplot_text(what_bars_are() + " of " + of_.outputs[output].name),
        static_cast<double>(bars.size()) - 0.3, names, stem);
  }

  void add_bands(std::size_t curve) {
    const std::string stem = "sweep-bands-" + file_part_of(of_.curves[curve].name);
    const MatrixXd& bands = of_.bands[curve];
    const VectorXd& time_s = of_.curves[curve].time_s;
    std::string csv;
    for (Index k = 0; k < time_s.size(); ++k) {
      csv += fmt::format("{:.9g}", 1e3 * time_s[k]);
      for (Index s = 0; s < bands.rows(); ++s) csv += fmt::format(",{:.9g}", bands(s, k));
      csv += "\n";
    }
    begin(stem, csv, 760, 460);
    script_ += fmt::format(
        "set xlabel 'time [ms]'\nset ylabel {}\nset key below\n"
        "plot '{}.csv' using 1:2:6 with filledcurves fc rgb '#cfe2ee' title '5 to 95 %', "
        "'' using 1:3:5 with filledcurves fc rgb '#8fbcd9' title '25 to 75 %', "
        "'' using 1:4 with lines lw 2 lc rgb '#0072b2' title 'median'\n",
        label_of(of_.curves[curve].name, of_.curves[curve].unit), stem);
  }

  /// @return the names of the pictures written to the folder
  std::vector<std::string> draw(const fs::path& folder) const {
    if (names_.empty()) return {};
    write_text(files_.path() / "sweep.gnuplot", script_, Durability::none);
    run_gnuplot(files_.path(), "sweep.gnuplot");
    for (const std::string& name : names_)
      write_text(folder / name, text_of_file(files_.path() / name), Durability::none);
    return names_;
  }

 private:
  struct Bar {
    std::string parameter;
    Estimate share;
  };

  std::string what_bars_are() const {
    const SweepPlan plan = of_.sweep.section().plan;
    return plan == SweepPlan::sobol_indices ? "total Sobol' indices"
           : plan == SweepPlan::shapley     ? "Shapley effects"
                                            : "rank correlation with parameters";
  }

  /// Bars of an output, the largest at the top.
  std::vector<Bar> bars_of(std::size_t output) const {
    const SweepPlan plan = of_.sweep.section().plan;
    if (plan == SweepPlan::grid || plan == SweepPlan::list) return {};
    const Sensitivity& known = of_.sensitivity[output];
    VectorXd correlations;
    if (plan != SweepPlan::sobol_indices && plan != SweepPlan::shapley)
      correlations = correlations_of(output);
    std::vector<Bar> bars;
    for (std::size_t i = 0; i < of_.sweep.units().size(); ++i) {
      Estimate share;
      if (i < known.sobol.size()) {
        share = known.sobol[i].total;
      } else if (i < known.shapley.size()) {
        share = known.shapley[i];
      } else if (correlations.size() > 0) {
        const double value = correlations[static_cast<Index>(i)];
        share = {value, {value, value}};
      } else {
        return {};
      }
      if (std::isnan(share.value)) return {};
      bars.push_back({of_.sweep.section().parameters[i].name, share});
    }
    std::stable_sort(bars.begin(), bars.end(), [](const Bar& a, const Bar& b) {
      return std::abs(a.share.value) < std::abs(b.share.value);
    });
    return bars;
  }

  VectorXd correlations_of(std::size_t output) const {
    VectorXd shown(inputs_.cols());
    for (std::size_t k = 0; k < rows_.size(); ++k)
      shown[static_cast<Index>(k)] =
          of_.table.figures(static_cast<Index>(output), static_cast<Index>(rows_[k]));
    return rank_correlations(inputs_, shown);
  }

  void begin(const std::string& stem, const std::string& csv, int width, int height) {
    write_text(files_.path() / (stem + ".csv"), csv, Durability::none);
    names_.push_back(stem + ".svg");
    script_ += picture_head(stem, width, height);
  }

  const SweepPictures& of_;
  std::vector<std::uint64_t> rows_;
  MatrixXd inputs_;  ///< inputs of these rows
  TemporaryFolder files_;
  std::string script_;
  std::vector<std::string> names_;
};

}  // namespace

VectorXd rank_correlations(const MatrixXd& inputs, const VectorXd& output) {
  std::vector<Index> known;
  for (Index k = 0; k < output.size(); ++k)
    if (!std::isnan(output[k])) known.push_back(k);
  VectorXd result(inputs.rows());
  VectorXd of_output = ranks_of(output(known));
  of_output.array() -= of_output.mean();
  for (Index i = 0; i < inputs.rows(); ++i) {
    VectorXd of_input = ranks_of(inputs.row(i)(known).transpose());
    of_input.array() -= of_input.mean();
    const double scale = of_input.norm() * of_output.norm();
    result[i] = scale > 0 ? of_input.dot(of_output) / scale : std::nan("");
  }
  return result;
}

std::vector<std::string> draw_sweep(const SweepPictures& pictures, const fs::path& folder) {
  Drawing drawing(pictures);
  for (std::size_t k = 0; k < pictures.outputs.size(); ++k) {
    drawing.add_scatter(k);
    drawing.add_tornado(k);
  }
  for (std::size_t k = 0; k < pictures.curves.size(); ++k) drawing.add_bands(k);
  return drawing.draw(folder);
}

}  // namespace flexneck::pipeline
