// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/results/report/fit_pictures.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/core.h>

#include "geometry/foundation/error.h"
#include "geometry/foundation/input_file.h"
#include "geometry/foundation/output_file.h"
#include "geometry/foundation/temporary_folder.h"
#include "pipeline/parameter_studies/fit/curve_terms.h"
#include "pipeline/results/plotting/figure.h"
#include "pipeline/results/plotting/gnuplot.h"

namespace flexneck::pipeline {

namespace fs = std::filesystem;
using Eigen::Index;

namespace {

constexpr int kPanels = 3;  ///< number of panels side by side

/// Pictures being drawn: one script for all.
class Drawing {
 public:
  /// @param start  observables at the start of the first fit
  Drawing(const StudyFit& fit, const FitResult& result, Eigen::VectorXd start)
      : fit_(fit), result_(result), start_(std::move(start)) {}

  void add_targets() {
    const std::vector<FitTerm>& terms = fit_.objective().terms();
    std::string csv;
    std::string names;
    std::size_t first = 0;
    const std::size_t count = fit_.targets().size();
    for (std::size_t k = 0; k < count; ++k) {
      double squares = 0;
      std::size_t end = first;
      double residual = 0;
      for (; end < terms.size() && terms[end].target == fit_.targets()[k].name; ++end) {
        residual = terms[end].residual(result_.best().values[static_cast<Index>(end)]);
        squares += residual * residual;
      }
      if (end - first > 1) residual = std::sqrt(squares / static_cast<double>(end - first));
      const std::size_t row = count - 1 - k;  // the first at the top
      csv += fmt::format("{:.9g},{},{}\n", residual, row, terms[first].is_held_out ? 1 : 0);
      names += fmt::format("{}{} {}", k > 0 ? ", " : "", gnuplot_tic(fit_.targets()[k].name), row);
      first = end;
    }
    begin("fit-targets", csv, 640, 120 + 32 * static_cast<int>(count));
    script_ += fmt::format(
        "set xlabel 'distance from the target in standard deviations'\nset yrange [-0.7:{}]\n"
        "set ytics ({}) noenhanced\nset yzeroaxis lt 1 lc rgb '#444444'\nset style fill solid 0.7\n"
        "set key below\n"
        "plot 'fit-targets.csv' using ($3==0?0:NaN):2:(0):1:($2-0.3):($2+0.3) with boxxyerror "
        "lc rgb '#0072b2' title 'fitted', '' using ($3==1?0:NaN):2:(0):1:($2-0.3):($2+0.3) with "
        "boxxyerror lc rgb '#d55e00' title 'held out'\n",
        static_cast<double>(count) - 0.3, names);
  }

  void add_profiles() {
    if (result_.profiles.empty()) return;
    const auto count = static_cast<int>(result_.profiles.size());
    std::string csv;  // one block per parameter
    for (std::size_t k = 0; k < result_.profiles.size(); ++k) {
      const FitRange& range = fit_.objective().ranges()[k];
      for (const Profile::Point& point : result_.profiles[k].points)
        csv += fmt::format("{},{:.9g},{:.9g}\n", k, range.from + point.place * range.width(),
                           point.chi_squared - result_.best().chi_squared);
    }
    begin_panels("fit-profiles", csv, count);
    script_ += "set yrange [-0.5:8]\nset ylabel 'chi-squared minus its minimum'\n";
    for (int k = 0; k < count; ++k)
      script_ += fmt::format(
          "set xlabel {}\nplot 'fit-profiles.csv' using ($1=={}?$2:NaN):3 with points pt 7 ps 0.5 "
          "lc rgb '#0072b2' notitle, 3.84 with lines dt 2 lc rgb '#444444' notitle\n",
          label_of(static_cast<std::size_t>(k)), k);
    script_ += "unset multiplot\n";
  }

  void add_history() {
    const HistoryMatch& history = result_.history;
    const auto count = static_cast<std::size_t>(history.places.rows());
    if (history.places.cols() == 0 || count < 2) return;
    // Maximum number of non-matching points: a page holds them for each pair.
    constexpr Index kMostPoints = 1500;
    std::string csv;
    Index missed = 0;
    for (Index k = 0; k < history.places.cols(); ++k) {
      const bool is_match = history.is_match[static_cast<std::size_t>(k)];
      if (!is_match && ++missed > kMostPoints) continue;
      for (const double each : fit_.objective().parameters(history.places.col(k)))
        csv += fmt::format("{:.6g},", each);
      csv += is_match ? "1\n" : "0\n";
    }
    const auto pairs = static_cast<int>(count * (count - 1) / 2);
    begin_panels("fit-history", csv, pairs);
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t j = i + 1; j < count; ++j)
        script_ += fmt::format(
            "set xlabel {}\nset ylabel {}\nplot 'fit-history.csv' using (${}==0?${}:NaN):{} with "
            "points pt 7 ps 0.2 lc rgb '#cccccc' notitle, '' using (${}==1?${}:NaN):{} with "
            "points pt 7 ps 0.6 lc rgb '#0072b2' notitle\n",
            label_of(i), label_of(j), count + 1, i + 1, j + 1, count + 1, i + 1, j + 1);
    script_ += "unset multiplot\n";
  }

  void add_curves() {
    const std::vector<FitTerm>& terms = fit_.objective().terms();
    std::size_t first = 0;
    for (std::size_t k = 0; k < fit_.targets().size(); ++k) {
      const FitTarget& target = fit_.section().targets[k];
      std::size_t end = first;
      while (end < terms.size() && terms[end].target == target.name) ++end;
      if (target.curve && !target.curve->rating) add_curve(k, first, end);
      first = end;
    }
  }

  /// @return the names of the pictures written to the folder
  std::vector<std::string> draw(const fs::path& folder) const {
    write_text(files_.path() / "fit.gnuplot", script_, Durability::none);
    run_gnuplot(files_.path(), "fit.gnuplot");
    for (const std::string& name : names_)
      write_text(folder / name, text_of_file(files_.path() / name), Durability::none);
    return names_;
  }

 private:
  void add_curve(std::size_t target, std::size_t first, std::size_t end) {
    const FitCurve& curve = *fit_.section().targets[target].curve;
    const ShownTarget& shown = fit_.targets()[target];
    std::string csv;
    const Eigen::VectorXd times_s = times_of_points(curve);
    for (std::size_t k = first; k < end; ++k) {
      const FitTerm& term = fit_.objective().terms()[k];
      const double low = term.window ? term.window->low : term.value - term.deviation;
      const double high = term.window ? term.window->high : term.value + term.deviation;
      const auto row = static_cast<Index>(k);
      csv += fmt::format("{:.9g},{:.9g},{:.9g},{:.9g},{:.9g}\n",
                         1e3 * times_s[row - static_cast<Index>(first)], low * shown.factor,
                         high * shown.factor, result_.best().values[row] * shown.factor,
                         start_[row] * shown.factor);
    }
    const std::string stem = "fit-curve-" + file_part_of(shown.name);
    begin(stem, csv, 760, 460);
    script_ += fmt::format(
        "set xlabel 'time [ms]'\nset ylabel {}\nset key below\n"
        "plot '{}.csv' using 1:{} title '{}', '' "
        "using 1:5 with lines lw 2 dt 2 lc rgb '#d55e00' title 'before the fit', '' "
        "using 1:4 with lines lw 2 lc rgb '#0072b2' title 'fit'\n",
        gnuplot_text(shown.name + " [" + shown.unit + "]"), stem,
        curve.corridor ? "2:3 with filledcurves lc rgb '#dddddd'"
                       : "(0.5*($2+$3)):2:3 with yerrorbars pt 7 ps 0.3 lc rgb '#888888'",
        curve.corridor ? "corridor" : "target");
  }

  std::string label_of(std::size_t parameter) const {
    const FitParameter& of = fit_.section().parameters[parameter];
    return gnuplot_text(of.unit.empty() ? of.name : of.name + " [" + of.unit + "]");
  }

  void begin_panels(const std::string& stem, const std::string& csv, int panels) {
    const int columns = std::min(panels, kPanels);
    const int lines = (panels + kPanels - 1) / kPanels;
    begin(stem, csv, 300 * columns, 280 * lines);
    script_ += fmt::format("set multiplot layout {},{}\n", lines, columns);
  }

  void begin(const std::string& stem, const std::string& csv, int width, int height) {
    write_text(files_.path() / (stem + ".csv"), csv, Durability::none);
    names_.push_back(stem + ".svg");
    script_ += picture_head(stem, width, height);
  }

  const StudyFit& fit_;
  const FitResult& result_;
  Eigen::VectorXd start_;
  TemporaryFolder files_;
  std::string script_;
  std::vector<std::string> names_;
};

/// Observables at the start; NaN if the model fails there.
Eigen::VectorXd observables_at_start(StudyFit& fit) {
  const auto none = [&] {
    return Eigen::VectorXd::Constant(static_cast<Index>(fit.objective().terms().size()),
                                     std::numeric_limits<double>::quiet_NaN());
  };
  try {
    return fit.observables(fit.objective().parameters(fit.start()));
  } catch (const InputError&) {
    return none();
  } catch (const ComputationError&) {
    return none();
  }
}

}  // namespace

std::vector<std::string> draw_fit(StudyFit& fit, const FitResult& result, const fs::path& folder) {
  Drawing drawing(fit, result, observables_at_start(fit));
  drawing.add_targets();
  drawing.add_profiles();
  drawing.add_history();
  drawing.add_curves();
  return drawing.draw(folder);
}

}  // namespace flexneck::pipeline
