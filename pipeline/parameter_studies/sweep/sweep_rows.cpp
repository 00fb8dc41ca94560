// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/parameter_studies/sweep/sweep_rows.h"

#include <utility>

#include "geometry/foundation/error.h"
#include "pipeline/parameter_studies/sampling/distribution.h"

namespace flexneck::pipeline {

namespace {

VariedKey varied_by(const SweepParameter& parameter) {
  return {"sweep.parameter '" + parameter.name + "'", parameter.key, parameter.unit};
}

std::uint64_t grid_size(const SweepSection& section) {
  std::uint64_t count = 1;
  for (const SweepParameter& each : section.parameters) {
    count *= each.level_count();
    if (count > SweepRows::kMaxRows) break;
  }
  return count;
}

UnitPoints points_of(const SweepSection& section) {
  return {section.plan, static_cast<std::uint32_t>(section.samples),
          static_cast<int>(section.parameters.size()), static_cast<std::uint64_t>(section.seed)};
}

}  // namespace

SweepRows::SweepRows(SweepSection section)
    : section_(std::move(section)),
      correlation_(section_),
      shapley_(static_cast<int>(section_.parameters.size()),
               static_cast<std::uint64_t>(section_.seed), correlation_),
      points_(points_of(section_)) {
  switch (section_.plan) {
    case SweepPlan::grid:
      count_ = grid_size(section_);
      break;
    case SweepPlan::list:
      count_ = section_.parameters.front().level_count();
      break;
    default:
      count_ = static_cast<std::uint64_t>(section_.samples) * rows_per_sample();
  }
  if (count_ > kMaxRows)
    throw InputError("sweep: expected at most 10^9 rows, found more; use fewer values or samples");
  for (const SweepParameter& each : section_.parameters) {
    SiUnit unit = si_unit_of(varied_by(each));
    units_.push_back(std::move(unit.name));
    factors_.push_back(unit.factor);
  }
}

std::uint64_t SweepRows::rows_per_sample() const {
  switch (section_.plan) {
    case SweepPlan::grid:
    case SweepPlan::list:
      return 1;
    case SweepPlan::shapley:
      return shapley_.rows_per_sample();
    default:
      return points_.rows_per_sample();
  }
}

double SweepRows::value_at(const SweepParameter& parameter, double probability) const {
  if (parameter.is_continuous()) return quantile(*parameter.distribution, probability);
  const std::size_t level = discrete_quantile(*parameter.distribution, probability);
  return parameter.texts.empty() ? parameter.values[level] : static_cast<double>(level);
}

std::vector<double> SweepRows::values(std::uint64_t row) const {
  const std::vector<SweepParameter>& parameters = section_.parameters;
  std::vector<double> values(parameters.size());
  const auto at_level = [&](std::size_t k, std::uint64_t level) {
    values[k] =
        parameters[k].texts.empty() ? parameters[k].values[level] : static_cast<double>(level);
  };
  if (section_.plan == SweepPlan::grid) {
    for (std::size_t k = parameters.size(); k-- > 0; row /= parameters[k].level_count())
      at_level(k, row % parameters[k].level_count());
    return values;
  }
  if (section_.plan == SweepPlan::list) {
    for (std::size_t k = 0; k < parameters.size(); ++k) at_level(k, row);
    return values;
  }
  const Eigen::VectorXd point = section_.plan == SweepPlan::shapley
                                    ? shapley_.point(row)
                                    : correlation_.correlated(points_.point(row));
  for (std::size_t k = 0; k < parameters.size(); ++k)
    values[k] = value_at(parameters[k], point[static_cast<Eigen::Index>(k)]);
  return values;
}

std::string SweepRows::setting(const SweepParameter& parameter, double value) {
  if (!parameter.texts.empty())
    return parameter.key + "=" + parameter.texts[static_cast<std::size_t>(value)];
  return setting_of(varied_by(parameter), value);
}

std::vector<std::string> SweepRows::settings(std::uint64_t row) const {
  const std::vector<double> all = values(row);
  std::vector<std::string> settings;
  settings.reserve(all.size());
  for (std::size_t k = 0; k < all.size(); ++k)
    settings.push_back(setting(section_.parameters[k], all[k]));
  return settings;
}

Eigen::VectorXd SweepRows::numbers(std::uint64_t row) const {
  const std::vector<double> all = values(row);
  Eigen::VectorXd numbers(static_cast<Eigen::Index>(all.size()));
  for (std::size_t k = 0; k < all.size(); ++k)
    numbers[static_cast<Eigen::Index>(k)] = all[k] * factors_[k];
  return numbers;
}

TwoSettings SweepRows::two_settings(std::size_t which) const {
  const SweepParameter& parameter = section_.parameters[which];
  const VariedKey varied = varied_by(parameter);
  if (parameter.is_continuous())
    return {varied, setting(parameter, value_at(parameter, 0.25)),
            setting(parameter, value_at(parameter, 0.75))};
  const auto at = [&](std::size_t level) {
    return parameter.texts.empty() ? parameter.values[level] : static_cast<double>(level);
  };
  const double first = at(0);
  double other = first;
  for (std::size_t level = 1; level < parameter.level_count() && other == first; ++level)
    other = at(level);
  return {varied, setting(parameter, first), setting(parameter, other)};
}

}  // namespace flexneck::pipeline
