// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/laboratory/rating/nij.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include <fmt/core.h>

#include "geometry/foundation/content_hash.h"
#include "geometry/foundation/error.h"
#include "pipeline/cli/commands.h"
#include "pipeline/laboratory/curve_file.h"
#include "pipeline/process/result_table.h"

namespace flexneck::pipeline {

namespace {

constexpr double kEqualIntervals = 1e-4;  ///< relative; times are written with few digits

/// Fails unless both curves have the same times: each channel of a test has its own file and times.
void require_times_of(const Curve& force, const Curve& other) {
  if (other.time_s.size() == force.time_s.size() && other.time_s == force.time_s) return;
  throw InputError(other.label() + ": expected the times of " + force.label() +
                   ", found others; record both channels together");
}

/// Interval between samples, s. @throws InputError unless it is constant, which the filter
/// requires.
double interval_of(const Curve& curve) {
  const Eigen::VectorXd& times_s = curve.time_s;
  const Eigen::Index count = times_s.size();
  const double interval_s = (times_s[count - 1] - times_s[0]) / static_cast<double>(count - 1);
  for (Eigen::Index k = 1; k < count; ++k) {
    const double found_s = times_s[k] - times_s[k - 1];
    if (std::abs(found_s - interval_s) <= kEqualIntervals * interval_s) continue;
    throw InputError(
        fmt::format("{}: the filter CFC 600 needs samples at equal intervals, here {:.6g} s; found "
                    "an interval of {:.6g} s after the time {:.6g} s",
                    curve.file, interval_s, found_s, times_s[k - 1]));
  }
  return interval_s;
}

/// Loads of the neck in SI units.
struct NeckLoads {
  Curve force, moment;
  std::optional<Curve> shear;
};

NeckLoads read_loads(const FileInput& input) {
  const NeckLoadChoice& choice = input.neck_loads;
  const auto load = [&](const std::string& column, const char* si_unit) {
    return in_unit(read_curve(input.files.front(), column), si_unit);
  };
  NeckLoads loads{load(choice.force, "N"), load(choice.moment, "N*m"), {}};
  if (!choice.shear.empty()) loads.shear = load(choice.shear, "N");
  require_times_of(loads.force, loads.moment);
  if (loads.shear) require_times_of(loads.force, *loads.shear);
  return loads;
}

/// Loads at the condyles. Each load is filtered by CFC 600 before they are combined, since some
/// channels of a test may have been filtered already.
CondyleLoads at_condyles(const NeckLoads& loads, double arm_m) {
  constexpr multibody::ChannelClass kClass = multibody::ChannelClass::cfc600;
  const double interval_s = interval_of(loads.force);
  const auto filtered = [&](const Curve& curve) -> Eigen::VectorXd {
    if (!needs_filter(curve, kClass)) return curve.values;
    try {
      return multibody::cfc_filtered(curve.values, interval_s, kClass);
    } catch (const InputError& error) {
      throw InputError(curve.file + ": " + error.what());
    }
  };
  CondyleLoads at = {filtered(loads.force), filtered(loads.moment), interval_s, true};
  if (loads.shear) at.moment_y_Nm = condyle_moment(filtered(*loads.shear), at.moment_y_Nm, arm_m);
  return at;
}

/// The input files, each once.
std::vector<InputFile> inputs_of(const NeckLoads& loads) {
  std::vector<InputFile> files;
  const auto add = [&](const Curve& curve) {
    const std::string name = curve.source.filename().string();
    const bool is_there = std::any_of(files.begin(), files.end(),
                                      [&](const InputFile& file) { return file.name == name; });
    if (!is_there) files.push_back({name, hash_of_file(curve.source.string())});
  };
  add(loads.force);
  add(loads.moment);
  if (loads.shear) add(*loads.shear);
  return files;
}

ResultTable table_of(const std::array<NijPeak, 4>& peaks, const Eigen::VectorXd& times_s,
                     const NeckIntercepts& intercepts) {
  ResultTable table = {
      "nij",
      "Nij at the occipital condyles",
      {{"measure", ""}, {"largest", ""}, {"at", "ms"}, {"Fz", "N"}, {"My", "N m"}, {"loads", ""}},
      {},
      {fmt::format("{}: {:g} N tension, {:g} N compression, {:g} N m flexion, {:g} N m extension",
                   intercepts.name, intercepts.tension_N, intercepts.compression_N,
                   intercepts.flexion_Nm, intercepts.extension_Nm),
       "CFC 600; not defined for pendulum tests"}};
  double largest = 0;
  for (const NijPeak& peak : peaks) {
    largest = std::max(largest, peak.value);
    const bool is_there = peak.value > 0;
    const auto number = [&](const char* format, double value) {
      return is_there ? fmt::format(fmt::runtime(format), value) : std::string("-");
    };
    table.rows.push_back({std::string(peak.name), fmt::format("{:.6f}", peak.value),
                          number("{:.2f}", 1e3 * times_s[peak.sample]),
                          number("{:.1f}", peak.force_N), number("{:.2f}", peak.moment_Nm),
                          std::string(peak.combination)});
  }
  table.rows.push_back({"Nij", fmt::format("{:.6f}", largest), "", "", "", "the largest"});
  return table;
}

}  // namespace

bool nij_command(const FileInput& input) {
  if (input.files.size() != 1)
    throw InputError("nij: expected one file, as in 'flexneck nij LOADS.csv', found " +
                     std::to_string(input.files.size()));
  const NeckLoadChoice& choice = input.neck_loads;
  const NeckIntercepts& intercepts = neck_intercepts(choice.dummy);
  const NeckLoads loads = read_loads(input);
  const Curve& force = loads.force;
  ResultTable table = table_of(nij(at_condyles(loads, intercepts.condyle_arm_m), intercepts),
                               force.time_s, intercepts);
  table.notes.insert(
      table.notes.begin(),
      fmt::format("{}: '{}', '{}'{}", force.file, choice.force, choice.moment,
                  choice.shear.empty() ? "" : " minus the arm times '" + choice.shear + "'"));
  if (!input.folder.path().empty()) {
    input.folder.make();
    write_tables(input.folder.file("nij.json"), {table}, provenance_of(inputs_of(loads), {}));
  }
  input.console.result(printed(table));
  return true;
}

}  // namespace flexneck::pipeline
