// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/rating/nij.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "geometry/foundation/content_hash.h"
#include "geometry/foundation/error.h"
#include "pipeline/commands/file_commands.h"
#include "pipeline/document/curve_file.h"
#include "pipeline/output/result_table.h"

namespace flexneck::pipeline {

namespace {

constexpr double kEqualIntervals = 1e-4;  ///< relative; times are written with few digits

Curve load(const FileInput& input, const std::string& column, const std::string& si_unit) {
  return in_unit(read_curve(input.files.front(), column), si_unit);
}

/// Between samples. @throws InputError unless it is the same everywhere: a filter needs that.
double interval_of(const Curve& curve) {
  const Eigen::VectorXd& times_s = curve.time_s;
  const Eigen::Index count = times_s.size();
  const double interval_s = (times_s[count - 1] - times_s[0]) / static_cast<double>(count - 1);
  for (Eigen::Index k = 1; k < count; ++k) {
    const double found_s = times_s[k] - times_s[k - 1];
    if (std::abs(found_s - interval_s) <= kEqualIntervals * interval_s) continue;
    throw InputError(
        fmt::format("{}: the filter CFC 600 takes samples at equal intervals, here {:.6g} s; found "
                    "{:.6g} s after the time {:.6g} s",
                    curve.file, interval_s, found_s, times_s[k - 1]));
  }
  return interval_s;
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
    throw InputError("nij: name one file, 'flexneck nij LOADS.csv', found " +
                     std::to_string(input.files.size()));
  const NeckLoadChoice& choice = input.neck_loads;
  const NeckIntercepts& intercepts = neck_intercepts(choice.dummy);
  const Curve force = load(input, choice.force, "N");
  const Curve moment = load(input, choice.moment, "N*m");
  CondyleLoads loads = {force.values, moment.values, interval_of(force)};
  if (!choice.shear.empty())
    loads.moment_y_Nm = condyle_moment(load(input, choice.shear, "N").values, moment.values,
                                       intercepts.condyle_arm_m);
  ResultTable table;
  try {
    table = table_of(nij(loads, intercepts), force.time_s, intercepts);
  } catch (const InputError& error) {
    throw InputError(force.file + ": " + error.what());
  }
  table.notes.insert(
      table.notes.begin(),
      fmt::format("{}: '{}', '{}'{}", force.file, choice.force, choice.moment,
                  choice.shear.empty() ? "" : " less the arm times '" + choice.shear + "'"));
  if (!input.folder.path().empty()) {
    input.folder.make();
    write_tables(
        input.folder.file("nij.json"), {table},
        provenance_of({{input.files[0].filename().string(), hash_of_file(input.files[0])}}, {}));
  }
  input.console.result(printed(table));
  return true;
}

}  // namespace flexneck::pipeline
