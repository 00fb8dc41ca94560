// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/results/report/figures/response_figures.h"

#include <algorithm>
#include <array>
#include <set>

#include <fmt/core.h>

#include "geometry/foundation/units.h"
#include "pipeline/results/plotting/curve_figure.h"
#include "pipeline/results/report/corridors.h"
#include "pipeline/results/report/curves.h"

namespace flexneck::pipeline {

namespace {

using Kind = Experiment::Kind;

/// A curve of a figure, named after its case's model unless it has a title.
struct CurveSpec {
  std::string experiment;
  std::string channel;
  bool is_optional = false;  ///< a variant, left out if it was not run
  std::string title = {};
};

struct ResponseFigure {
  int number;
  std::string caption;
  std::string remark;
  Kind kind;
  std::string against;  ///< channel of the x axis, or "time"
  std::string y_label;  ///< without its unit
  std::vector<CurveSpec> curves;
};

std::vector<CurveSpec> deformable_and_rigid(const std::string& channel) {
  return {{"flexion-20", channel},
          {"flexion-20-rigid", channel, true},
          {"flexion-20-equivalent", channel, true}};
}

std::vector<CurveSpec> rotations(const std::string& experiment) {
  return {{experiment, "head rotation", false, "head rotation φ"},
          {experiment, "neck rotation", false, "neck rotation φ′"}};
}

std::vector<CurveSpec> accelerations(const std::string& experiment) {
  const std::string channel = "head acceleration filtered";
  return {{experiment, channel}, {experiment + "-spring", channel, true}};
}

/// Remark with the text's numbering of the rotations' figures.
std::string rotation_remark(const std::string& in_text) {
  return "Head and neck rotation against the arm. " + in_text;
}

const std::vector<ResponseFigure>& response_list() {
  static const std::vector<ResponseFigure> list = {
      {6,
       "Moment vs. rotation in Hybrid III static test [4] and simulation",
       "Also figure 6 in the text. The measured curve of [4] is not published.",
       Kind::static_test,
       "rotation",
       "base moment",
       {{"flexion", "base moment"}, {"flexion-chain", "base moment", true}}},
      {8, "Comparison of Hybrid III head rotations in HNP 20° flexion test",
       "Also figure 8 in the text. The measured curve is not published.", Kind::pendulum, "time",
       "head rotation", deformable_and_rigid("head rotation")},
      {9, "Comparison of Hybrid III head rotations in HNP 20° flexion test",
       "The caption repeats that of figure 8; by the text this is the forward acceleration of the "
       "head's centre of gravity, as drawn here.",
       Kind::pendulum, "time", "head c.g. acceleration",
       deformable_and_rigid("head acceleration filtered")},
      {10, "Hybrid III rotations in HNP 20° flexion test",
       rotation_remark("The text has 20°, 60° and 120° as figures 11–13."), Kind::pendulum, "time",
       "rotation", rotations("flexion-20")},
      {11, "Hybrid III rotations in HNP 60° flexion test",
       rotation_remark("Figure 12 in the order of the text."), Kind::pendulum, "time", "rotation",
       rotations("flexion-60")},
      {12, "Hybrid III rotations in HNP 120° flexion test",
       rotation_remark(
           "Figure 13 in the order of the text, but figure 12 in the sentence on its peak."),
       Kind::pendulum, "time", "rotation", rotations("flexion-120")},
      {13, "Hybrid III rotations in HNP 65° lateral test",
       rotation_remark("Not mentioned in the text."), Kind::pendulum, "time", "rotation",
       rotations("lateral-65")},
      {14, "Head x acceleration in HNP 60° flexion test", "Also figure 14 in the text.",
       Kind::pendulum, "time", "head c.g. acceleration", accelerations("flexion-60")},
      {15, "Head x acceleration in HNP 120° flexion test", "Also figure 15 in the text.",
       Kind::pendulum, "time", "head c.g. acceleration", accelerations("flexion-120")},
      {16,
       "Moments for 60° flexion and 65° lateral tests",
       "Also figure 16 in the text. The joint is not stated; the moment about the occipital "
       "condyles is drawn.",
       Kind::pendulum,
       "time",
       "moment",
       {{"flexion-60", "occipital moment"},
        {"lateral-65", "occipital moment"},
        {"flexion-60-spring", "occipital moment", true},
        {"lateral-65-spring", "occipital moment", true}}},
  };
  return list;
}

/// Name of a run's model, from its history and the study's case.
std::string model_of(const Experiment& experiment, const Study& study) {
  const auto found =
      std::find_if(study.cases.begin(), study.cases.end(),
                   [&](const CaseSection& each) { return each.name == experiment.name; });
  if (found != study.cases.end() && !found->variant.empty())
    return "variant '" + found->variant + "'";
  const std::size_t bodies = experiment.file.history.modal.size();
  return bodies == 1 ? "one deformable body" : fmt::format("{} deformable bodies", bodies);
}

const multibody::Channel* channel_of(const Experiment* experiment, const std::string& name) {
  if (experiment == nullptr) return nullptr;
  const auto& channels = experiment->file.channels;
  const auto found = std::find_if(channels.begin(), channels.end(),
                                  [&](const auto& channel) { return channel.name == name; });
  return found == channels.end() || found->values.rows() != 1 ? nullptr : &*found;
}

/// A channel in its display unit.
Eigen::VectorXd shown_values(const multibody::Channel& channel, Kind kind) {
  return channel.values.row(0).transpose() *
         factor_from_si(channel.unit, shown_unit(channel.unit, kind));
}

/// Axis label such as "base moment [in*lbf]".
std::string label(const std::string& name, const std::string& si_unit, Kind kind) {
  const std::string unit = shown_unit(si_unit, kind);
  return name + " [" + (unit == "gn" ? "g" : unit) + "]";
}

/// Corridors behind the figure's curves. @param sources  gets their sources, each once
std::vector<FigureBand> bands_of(const ResponseFigure& figure, const Study& study,
                                 std::set<std::string>& sources) {
  std::vector<FigureBand> bands;
  for (const Corridor& corridor : corridors_of(study)) {
    const bool applies =
        std::any_of(figure.curves.begin(), figure.curves.end(), [&](const CurveSpec& curve) {
          return curve.experiment == corridor.experiment && curve.channel == corridor.channel;
        });
    if (!applies) continue;
    const double factor = factor_from_si(corridor.unit, shown_unit(corridor.unit, figure.kind));
    bands.push_back({corridor.what, 1e3 * corridor.times_s.low, 1e3 * corridor.times_s.high,
                     corridor.values.low * factor, corridor.values.high * factor});
    sources.insert(corridor.source);
  }
  return bands;
}

Figure drawn(const ResponseFigure& spec, const Results& results, const Study& study) {
  Figure figure{spec.number, spec.caption, spec.remark};
  CurvePlot plot;
  const bool is_over_time = spec.against == "time";
  for (const CurveSpec& curve : spec.curves) {
    const Experiment* const experiment = results.find(spec.kind, curve.experiment);
    const multibody::Channel* const y = channel_of(experiment, curve.channel);
    const multibody::Channel* const x = channel_of(experiment, spec.against);
    if (y == nullptr || (x == nullptr && !is_over_time)) {
      const std::string what = "'" + curve.channel + "' of the case " + curve.experiment;
      if (!curve.is_optional) figure.missing += (figure.missing.empty() ? "" : ", ") + what;
      if (curve.is_optional) figure.remark += " Not run: " + curve.experiment + ".";
      continue;
    }
    plot.x_label = is_over_time ? "time [ms]" : label(spec.against, x->unit, spec.kind);
    plot.y_label = label(spec.y_label, y->unit, spec.kind);
    const std::string model = curve.experiment + ": " + model_of(*experiment, study);
    plot.curves.push_back({curve.title.empty() ? model : curve.title,
                           is_over_time ? Eigen::VectorXd(1e3 * experiment->file.history.time_s)
                                        : shown_values(*x, spec.kind),
                           shown_values(*y, spec.kind)});
  }
  if (!figure.missing.empty() || plot.curves.empty()) return figure;
  std::set<std::string> sources;
  plot.bands = bands_of(spec, study, sources);
  for (const std::string& source : sources) figure.remark += " Grey: " + source + ", for context.";
  draw_curves(plot, figure);
  return figure;
}

}  // namespace

std::vector<Figure> response_figures(const Results& results, const Study& study) {
  std::vector<Figure> figures;
  for (const ResponseFigure& spec : response_list()) {
    figures.push_back(drawn(spec, results, study));
  }
  return figures;
}

}  // namespace flexneck::pipeline
