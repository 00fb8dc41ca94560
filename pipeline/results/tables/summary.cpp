// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/results/tables/summary.h"

#include <fmt/core.h>

#include "multibody/analysis/linearisation.h"
#include "pipeline/process/text_table.h"

namespace flexneck::pipeline {

std::string run_summary(const multibody::History& history) {
  const multibody::StepStatistics& steps = history.statistics;
  std::string text = fmt::format(
      "  {} output times to {:.6g} s; {} steps, {} rejected, {} evaluations of the equations",
      history.handed_on + history.time_s.size(),
      history.time_s.size() > 0 ? history.time_s.tail<1>()[0] : 0.0, steps.accepted, steps.rejected,
      steps.evaluations);
  for (const multibody::StepLimit& limit : steps.limits)
    text += fmt::format("\n  {} of the steps limited by {}", limit.steps, limit.what);
  // Joint coordinates have no constraints.
  if (steps.max_position_residual > 0 || steps.max_velocity_residual > 0)
    text += fmt::format(
        "\n  largest constraint errors: {:.1e} in position (m, rad) and {:.1e} in velocity (per s)",
        steps.max_position_residual, steps.max_velocity_residual);
  if (history.freedoms >= 0)
    text += fmt::format("\n  {} degrees of freedom at the start; velocities minus constraints: {}",
                        history.freedoms,
                        history.freedoms - static_cast<int>(history.redundant_constraints.size()));
  if (!history.redundant_constraints.empty()) {
    text += fmt::format("\n  {} redundant constraints were omitted:",
                        history.redundant_constraints.size());
    for (const std::string& row : history.redundant_constraints) text += "\n    " + row;
  }
  for (const multibody::JointHistory& joint : history.joints)
    if (!joint.undetermined.empty())
      text +=
          "\n  undetermined in the reaction of joint '" + joint.name + "': " + joint.undetermined;
  if (!history.incomplete.empty()) text += "\n  INCOMPLETE: " + history.incomplete;
  return text;
}

std::string mode_summary(const multibody::LinearisationRecord& linearisation) {
  std::vector<std::vector<std::string>> rows = {{"mode about " + linearisation.about, "Hz",
                                                 "damped Hz", "damping", "largest motion",
                                                 "along"}};
  for (const multibody::ModeShape& each : linearisation.modes) {
    std::vector<std::string> row = {std::to_string(rows.size()),
                                    fmt::format("{:.5g}", each.mode.frequency_Hz),
                                    fmt::format("{:.5g}", each.mode.damped_frequency_Hz),
                                    fmt::format("{:.4g}", each.mode.damping_ratio)};
    const bool slides = !each.translation.isZero(0);
    const Eigen::Matrix3Xd sizes = (slides ? each.translation : each.rotation).cwiseAbs();
    Eigen::Index axis = 0;
    Eigen::Index marker = 0;
    if (sizes.size() > 0 && sizes.maxCoeff(&axis, &marker) > 0) {
      row.push_back(linearisation.markers[static_cast<std::size_t>(marker)]);
      row.push_back(std::string(slides ? "" : "about ") + "xyz"[axis]);
    } else {
      row.insert(row.end(), {"", ""});
    }
    if (each.mode.is_unstable())
      row.back() += fmt::format("  UNSTABLE, grows by {:.4g} / s", each.mode.growth_rate_1_s);
    rows.push_back(row);
  }
  return text_table(rows, {0, 4, 5});
}

void PeakTable::append(const Eigen::VectorXd& time_s,
                       const std::vector<multibody::Channel>& channels) {
  if (time_s.size() == 0) return;
  const bool is_first = curves_.empty();
  std::size_t k = 0;
  for (const multibody::Channel& channel : channels)
    for (Eigen::Index row = 0; row < channel.values.rows(); ++row, ++k) {
      Eigen::Index low = 0;
      Eigen::Index high = 0;
      const double smallest = channel.values.row(row).minCoeff(&low);
      const double largest = channel.values.row(row).maxCoeff(&high);
      if (is_first)
        curves_.push_back({row == 0 ? channel.name : "",
                           channel.columns[static_cast<std::size_t>(row)], channel.unit,
                           channel.filter, smallest, time_s[low], largest, time_s[high]});
      Curve& curve = curves_[k];
      if (smallest < curve.smallest) {
        curve.smallest = smallest;
        curve.smallest_s = time_s[low];
      }
      if (largest > curve.largest) {
        curve.largest = largest;
        curve.largest_s = time_s[high];
      }
    }
}

std::string PeakTable::text() const {
  std::vector<std::vector<std::string>> rows = {
      {"channel", "", "unit", "smallest", "at s", "largest", "at s"}};
  for (const Curve& curve : curves_)
    rows.push_back({curve.channel, curve.column + (curve.filter.empty() ? "" : ", " + curve.filter),
                    curve.unit, fmt::format("{:.5g}", curve.smallest),
                    fmt::format("{:.4f}", curve.smallest_s), fmt::format("{:.5g}", curve.largest),
                    fmt::format("{:.4f}", curve.largest_s)});
  return text_table(rows, {0, 1, 2});
}

}  // namespace flexneck::pipeline
