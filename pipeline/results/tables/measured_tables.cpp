// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/results/tables/measured_tables.h"

#include <filesystem>

#include <fmt/core.h>

#include "geometry/foundation/error.h"
#include "geometry/foundation/names.h"
#include "geometry/foundation/units.h"
#include "multibody/signals/response.h"
#include "pipeline/laboratory/rating/cora.h"
#include "pipeline/laboratory/rating/iso18571.h"
#include "pipeline/laboratory/rating/resampling.h"
#include "pipeline/language/model/model_sections.h"
#include "pipeline/process/customary_units.h"

namespace flexneck::pipeline {

using Eigen::Index;
using Eigen::VectorXd;
using LimitedFigure = MeasuredLimit::Figure;

namespace {

std::string where(const MeasuredTest& test) {
  return "test." + test.name + ", case " + test.experiment + ": ";
}

/// Calls make() and prefixes the test's name to its input errors.
template <class Make>
auto of_test(const MeasuredTest& test, const Make& make) {
  try {
    return make();
  } catch (const InputError& error) {
    throw InputError(where(test) + error.what());
  }
}

std::vector<std::string> curve_row(const MeasuredRun& run, const MeasuredCurve& measured) {
  const Curve computed = computed_curve(*run.run, measured.channel);
  const ResampledPair pair =
      resampled(in_unit(measured.curve, computed.unit), computed, {measured.from_s, measured.to_s});
  SampleRange range{0, pair.reference.size() - 1};
  if (!measured.from_s && !measured.to_s) range = cora_interval(pair.reference);
  const Index count = range.last - range.first + 1;
  const double iso = rate_iso18571(pair.reference, pair.computed).overall;
  const double cora = rate_cora(pair.reference.segment(range.first, count),
                                pair.computed.segment(range.first, count))
                          .overall;
  const std::string file = std::filesystem::path(measured.curve.file).filename().string();
  return {run.test.name,
          run.test.experiment,
          measured.channel,
          file + (measured.curve.column.empty() ? "" : ": " + measured.curve.column),
          fmt::format("{:.1f}", 1e3 * pair.from_s),
          fmt::format("{:.1f}", 1e3 * pair.to_s()),
          fmt::format("{:.3f}", iso),
          fmt::format("{:.3f}", cora)};
}

/// Note on a measured channel of ISO-MME whose class differs from the computed one's; else empty.
std::string filter_difference(const MeasuredRun& run, const MeasuredCurve& measured) {
  if (!measured.curve.filter) return {};
  const MmeFilter& filter = *measured.curve.filter;
  const std::string computed =
      run.run->channels[find_name(names_of(run.run->channels), measured.channel, "channel")].filter;
  const bool is_open = !filter.passed && !filter.is_special;
  if (filter.text == computed || (is_open && computed.empty())) return {};
  const auto text = [](std::string_view name) {
    return name.empty() ? std::string("no filter") : std::string(name);
  };
  return where(run.test) + "'" + measured.channel + "' is filtered with " + text(filter.text) +
         " in the measurement and with " + text(computed) + " in the computation.";
}

/// Value interpolated linearly between the samples of a curve that covers the time.
double value_at(const Curve& curve, double time_s) {
  Index k = 1;
  while (k + 1 < curve.time_s.size() && curve.time_s[k] < time_s) ++k;
  const double share = (time_s - curve.time_s[k - 1]) / (curve.time_s[k] - curve.time_s[k - 1]);
  return curve.values[k - 1] + share * (curve.values[k] - curve.values[k - 1]);
}

/// Agreement of a curve with a corridor of its unit, at the curve's own samples.
struct CorridorFigures {
  double share_inside = 0;
  double furthest = 0;  ///< largest distance outside, signed; 0 if always inside
  double furthest_s = 0;
};

CorridorFigures compared(const Curve& computed, const Curve& lower, const Curve& upper) {
  const double from_s = lower.time_s[0];
  const double to_s = lower.time_s[lower.time_s.size() - 1];
  if (computed.time_s[0] > from_s || computed.time_s[computed.time_s.size() - 1] < to_s)
    throw InputError(fmt::format("the corridor is from {:g} to {:g} s, but the run ends at {:g} s",
                                 from_s, to_s, computed.time_s[computed.time_s.size() - 1]));
  CorridorFigures figures;
  Index all = 0;
  Index inside = 0;
  for (Index k = 0; k < computed.time_s.size(); ++k) {
    const double time_s = computed.time_s[k];
    if (time_s < from_s || time_s > to_s) continue;
    const double above = computed.values[k] - value_at(upper, time_s);
    const double below = computed.values[k] - value_at(lower, time_s);
    ++all;
    inside += above <= 0 && below >= 0 ? 1 : 0;
    const double out = above > 0 ? above : std::min(below, 0.0);
    if (std::abs(out) <= std::abs(figures.furthest)) continue;
    figures.furthest = out;
    figures.furthest_s = time_s;
  }
  if (all == 0) throw InputError("no sample of the run is within the times of the corridor");
  figures.share_inside = static_cast<double>(inside) / static_cast<double>(all);
  return figures;
}

std::vector<std::string> corridor_row(const MeasuredRun& run, const MeasuredCorridor& corridor) {
  const Curve computed = computed_curve(*run.run, corridor.channel);
  const std::string shown = customary_unit(computed.unit, "lbf*ft");
  const CorridorFigures figures = compared(in_unit(computed, shown), in_unit(corridor.lower, shown),
                                           in_unit(corridor.upper, shown));
  const bool is_inside = figures.furthest == 0;
  return {run.test.name,
          run.test.experiment,
          corridor.channel,
          "corridor",
          fmt::format("{:.1f} % inside", 100 * figures.share_inside),
          is_inside ? ""
                    : fmt::format("off by {:+.3g} at {:.1f} ms", figures.furthest,
                                  1e3 * figures.furthest_s),
          shown,
          is_inside ? "pass" : "FAIL"};
}

/// A figure of a channel in SI units; none if the channel has none.
std::optional<double> figure_of(const Curve& computed, LimitedFigure figure) {
  const multibody::Peak peak = multibody::largest_peak(computed.time_s, computed.values);
  if (figure == LimitedFigure::peak) return peak.value;
  if (figure == LimitedFigure::time_of_peak) return peak.time_s;
  const multibody::FreeOscillation after = multibody::free_oscillation(
      computed.time_s, computed.values, computed.values[0], peak.time_s);
  if (after.crossings_s.empty()) return {};
  return after.crossings_s.front();
}

const char* name_of(LimitedFigure figure) {
  switch (figure) {
    case LimitedFigure::peak:
      return "peak";
    case LimitedFigure::time_of_peak:
      return "time of peak";
    case LimitedFigure::first_zero_crossing:
      break;
  }
  return "first zero crossing";
}

std::vector<std::string> limit_row(const MeasuredRun& run, const MeasuredLimit& limit) {
  const Curve computed = computed_curve(*run.run, limit.channel);
  const std::string unit = limit.figure == LimitedFigure::peak ? computed.unit : "s";
  const std::string shown = unit == "s" ? "ms" : customary_unit(unit, "lbf*ft");
  const double factor = factor_from_si(unit, shown);
  const auto bound = [&](const char* key, const std::string& text) -> std::optional<double> {
    if (text.empty()) return {};
    return at_key(limit.table, key, [&] { return parse_quantity(text, unit); });
  };
  const std::optional<double> low = bound("low", limit.low);
  const std::optional<double> high = bound("high", limit.high);
  if (low && high && *low > *high) limit.table.refuse("high", "expected a value above low");
  const std::optional<double> value = figure_of(computed, limit.figure);
  const bool is_inside = value && (!low || *value >= *low) && (!high || *value <= *high);
  const auto text = [&](const std::optional<double>& number) {
    return number ? fmt::format("{:.4g}", factor * *number) : std::string();
  };
  return {run.test.name,
          run.test.experiment,
          limit.channel,
          name_of(limit.figure),
          value ? text(value) : "not found",
          low && high ? text(low) + " to " + text(high)
                      : (low ? "at least " + text(low) : "at most " + text(high)),
          shown,
          is_inside ? "pass" : "FAIL"};
}

void note_missing_runs(const std::vector<MeasuredRun>& runs, ResultTable& table) {
  for (const MeasuredRun& run : runs)
    if (!run.run)
      table.notes.push_back("There is no run of " + run.test.experiment + " yet, on which test '" +
                            run.test.name + "' is based.");
}

}  // namespace

Curve computed_curve(const multibody::HistoryFile& run, const std::string& channel) {
  const multibody::Channel& found =
      run.channels[find_name(names_of(run.channels), channel, "channel")];
  if (found.values.rows() != 1)
    throw InputError("the channel '" + channel + "' has several columns; one is needed");
  return {"computed", channel, found.unit, run.history.time_s, found.values.row(0).transpose()};
}

ResultTable measured_curve_table(const std::vector<MeasuredRun>& runs) {
  ResultTable table;
  table.name = "measured curves";
  table.title = "Computed curves rated against measured ones";
  table.columns = {{"test", ""},   {"case", ""}, {"channel", ""},      {"measured", ""},
                   {"from", "ms"}, {"to", "ms"}, {"ISO/TS 18571", ""}, {"CORA", ""}};
  for (const MeasuredRun& run : runs)
    for (const MeasuredCurve& curve : run.test.curves) {
      if (!run.run) continue;
      table.rows.push_back(of_test(run.test, [&] { return curve_row(run, curve); }));
      const std::string difference = filter_difference(run, curve);
      if (!difference.empty()) table.notes.push_back(difference);
    }
  note_missing_runs(runs, table);
  table.notes.emplace_back(
      "1 is full agreement. 'flexneck rate MEASURED.csv COMPUTED.csv' prints the parts of each "
      "rating. Agreement shows a good model only if the curve was not used to choose its "
      "parameters.");
  return table;
}

ResultTable measured_limit_table(const std::vector<MeasuredRun>& runs) {
  ResultTable table;
  table.name = "measured limits";
  table.title = "Computed curves against corridors and limits";
  table.columns = {{"test", ""},  {"case", ""},   {"channel", ""}, {"figure", ""},
                   {"value", ""}, {"limits", ""}, {"unit", ""},    {"verdict", ""}};
  for (const MeasuredRun& run : runs) {
    if (!run.run) continue;
    for (const MeasuredCorridor& corridor : run.test.corridors)
      table.rows.push_back(of_test(run.test, [&] { return corridor_row(run, corridor); }));
    for (const MeasuredLimit& limit : run.test.limits)
      table.rows.push_back(of_test(run.test, [&] { return limit_row(run, limit); }));
  }
  note_missing_runs(runs, table);
  return table;
}

}  // namespace flexneck::pipeline
