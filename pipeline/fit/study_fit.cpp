// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/fit/study_fit.h"

#include <algorithm>
#include <utility>

#include <fmt/core.h>

#include "geometry/foundation/error.h"
#include "geometry/foundation/units.h"
#include "pipeline/document/product_text.h"
#include "pipeline/fit/target_terms.h"

namespace flexneck::pipeline {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

/// Linear between the samples. @pre the samples cover the time
double interpolated(const VectorXd& times_s, const VectorXd& values, double time_s) {
  const auto after = std::lower_bound(times_s.begin() + 1, times_s.end() - 1, time_s);
  const Index k = after - times_s.begin();
  const double share =
      std::clamp((time_s - times_s[k - 1]) / (times_s[k] - times_s[k - 1]), 0.0, 1.0);
  return (1 - share) * values[k - 1] + share * values[k];
}

double time_of_point(const FitCurve& curve, int point) {
  return curve.from_s + (curve.to_s - curve.from_s) * point / (curve.points - 1);
}

}  // namespace

StudyFit::StudyFit(Evaluator& evaluator, FitSection section, unsigned threads)
    : evaluator_(evaluator), section_(std::move(section)) {
  std::vector<FitTerm> all = terms();
  check_parameters();
  const auto plain = [this](const VectorXd& at) { return observables(at); };
  differences_ = central_differences(plain, ranges(), threads);
  FitModel model{[this](const VectorXd& at) { return values(at); },
                 [this](const VectorXd& at) { return slopes(at); }};
  objective_.emplace(ranges(), std::move(all), std::move(model));
  find_start();
  look_for_closed_slopes();
  check_produced();
}

VariedKey StudyFit::varied(std::size_t parameter) const {
  const FitParameter& of = section_.parameters[parameter];
  return {"fit.parameter '" + of.name + "'", of.key, of.unit};
}

std::vector<FitRange> StudyFit::ranges() const {
  std::vector<FitRange> all;
  for (const FitParameter& each : section_.parameters) {
    all.push_back({each.name, each.from, each.to, {}});
    if (each.mean) all.back().prior = FitRange::Normal{*each.mean, each.standard_deviation};
  }
  return all;
}

void StudyFit::check_parameters() const {
  std::vector<TwoSettings> all;
  for (std::size_t k = 0; k < section_.parameters.size(); ++k) {
    const FitParameter& each = section_.parameters[k];
    static_cast<void>(si_unit_of(varied(k)));
    const auto at = [&](double share) {
      return setting_of(varied(k), each.from + share * (each.to - each.from));
    };
    all.push_back({varied(k), at(0.25), at(0.75)});
  }
  check_varied(evaluator_, all, wanted_, "fit", "the targets");
}

void StudyFit::find_start() {
  VectorXd at(static_cast<Index>(section_.parameters.size()));
  const Study& study = evaluator_.base();
  for (std::size_t k = 0; k < section_.parameters.size(); ++k) {
    const FitParameter& each = section_.parameters[k];
    const auto refuse = [&](const std::string& why) {
      throw InputError(study.file.string() + ": " + varied(k).who + ": " + why);
    };
    double& value = at[static_cast<Index>(k)];
    if (each.start) {
      value = *each.start;
      continue;
    }
    const Parameter* found = nullptr;
    for (const std::vector<Parameter>* const list : {&study.defaults, &study.parameters})
      for (const Parameter& parameter : *list)
        if (parameter.key == each.key) found = &parameter;
    if (found == nullptr)
      refuse("expected the key start, since the study has no value of '" + each.key + "'");
    try {
      const SiUnit unit = si_unit_of(varied(k));
      value = unit.name == "1" ? parse_product(found->value).number
                               : parse_quantity(found->value, unit.name) / unit.factor;
    } catch (const InputError&) {
      refuse("expected the key start, since the study's value is no number: " + found->value);
    }
    if (!(each.from <= value && value <= each.to))
      refuse(
          fmt::format("expected bounds that hold the start, found {:g} to {:g} and the study's "
                      "{}; widen them, or give start",
                      each.from, each.to, found->value));
  }
  start_ = objective_->place(at);
}

void StudyFit::add_figure_terms(const FitTarget& target, std::vector<FitTerm>& terms) {
  WantedOutputs found;
  try {
    found = evaluator_.wanted({target.output}, {});
  } catch (const InputError& error) {
    target.table.refuse("output", error.what());
  }
  wanted_.figures.push_back(found.figures.front());
  const std::string si_unit = unit_of(found.figures.front(), evaluator_.base());
  terms.push_back(target.is_window() ? window_term(target, si_unit) : value_term(target, si_unit));
  const auto [unit, factor] = unit_of_text(
      !target.value.empty() ? target.value : (target.low.empty() ? target.high : target.low),
      si_unit);
  targets_.push_back({target.name, target.output, unit, factor, wanted_text(target), {}});
}

void StudyFit::add_curve_terms(const FitTarget& target, std::vector<FitTerm>& terms) {
  const FitCurve& curve = *target.curve;
  WantedOutputs found;
  Curve wanted;
  try {
    found = evaluator_.wanted({}, {curve.output});
    wanted = in_unit(curve.target, unit_of_curve(found.curves.front()));
  } catch (const InputError& error) {
    target.table.refuse("curve", error.what());
  }
  const double end_s = case_of(found.curves.front(), evaluator_.base()).duration_s;
  if (curve.from_s < 0 || curve.to_s > end_s)
    target.table.refuse("to", fmt::format("expected times within the case, 0 s to {:g} s, found "
                                          "{:g} s to {:g} s",
                                          end_s, curve.from_s, curve.to_s));
  wanted_.curves.push_back(found.curves.front());
  const std::string si_unit = unit_of_curve(found.curves.front());
  if (curve.rating) {
    terms.push_back(target.is_window() ? window_term(target, "1") : value_term(target, "1"));
    targets_.push_back({target.name, curve.output, "1", 1, wanted_text(target), {}});
    return;
  }
  const double deviation =
      number_of(target, "standard_deviation", target.standard_deviation, si_unit);
  if (!(deviation > 0)) target.table.refuse("standard_deviation", "expected a positive value");
  for (int k = 0; k < curve.points; ++k)
    terms.push_back({target.name,
                     interpolated(wanted.time_s, wanted.values, time_of_point(curve, k)),
                     deviation,
                     {},
                     target.is_held_out});
  const auto [unit, factor] = unit_of_text(target.standard_deviation, si_unit);
  targets_.push_back({target.name,
                      curve.output,
                      unit,
                      factor,
                      std::filesystem::path(curve.target.file).filename().string() + " +- " +
                          target.standard_deviation,
                      {}});
}

std::vector<FitTerm> StudyFit::terms() {
  std::vector<FitTerm> all;
  for (const FitTarget& each : section_.targets) {
    each.curve ? add_curve_terms(each, all) : add_figure_terms(each, all);
    targets_.back().origin = origin_of(evaluator_.base(), each);
  }
  return all;
}

std::vector<std::string> StudyFit::settings(const VectorXd& parameters) const {
  std::vector<std::string> all;
  for (std::size_t k = 0; k < section_.parameters.size(); ++k)
    all.push_back(setting_of(varied(k), parameters[static_cast<Index>(k)]));
  return all;
}

VectorXd StudyFit::observables_of(const Evaluation& evaluation) const {
  std::vector<double> values;
  Index figure = 0;
  std::size_t place = 0;  // of a curve
  for (const FitTarget& target : section_.targets) {
    if (!target.curve) {
      values.push_back(evaluation.figures[figure++]);
      continue;
    }
    const FitCurve& wanted = *target.curve;
    const VectorXd& times_s = evaluation.times_s[place];
    const VectorXd& curve = evaluation.curves[place];
    if (wanted.rating) {
      const std::string unit = unit_of_curve(wanted_.curves[place]);
      values.push_back(rating_of(
          wanted, in_unit({wanted.output, "", unit, times_s, curve}, wanted.target.unit)));
    } else {
      for (int k = 0; k < wanted.points; ++k)
        values.push_back(interpolated(times_s, curve, time_of_point(wanted, k)));
    }
    ++place;
  }
  return VectorXd::Map(values.data(), static_cast<Index>(values.size()));
}

bool StudyFit::is_accepted(const VectorXd& parameters) {
  try {
    static_cast<void>(study(parameters));
    return true;
  } catch (const InputError&) {
    return false;
  }
}

VectorXd StudyFit::observables(const VectorXd& parameters) {
  const Evaluation evaluation = evaluator_.evaluate(settings(parameters), wanted_);
  if (!evaluation.problem.empty()) throw ComputationError(evaluation.problem);
  return observables_of(evaluation);
}

StudyFit::Moved StudyFit::moved(const VectorXd& parameters, double direction) const {
  constexpr double kStep = 1e-3;  // of the range
  Moved all;
  for (Index k = 0; k < parameters.size(); ++k) {
    const FitRange& range = objective_->ranges()[static_cast<std::size_t>(k)];
    const double step = direction * kStep * range.width();
    const double end = parameters[k] + step;
    const double side = end < range.from || end > range.to ? -step : step;
    VectorXd other = parameters;
    other[k] += side;
    all.emplace_back(settings(other), side);
  }
  return all;
}

void StudyFit::look_for_closed_slopes() {
  const VectorXd at = objective_->parameters(start_);
  std::vector<std::vector<std::string>> others;
  for (const auto& [other, width] : moved(at, 1)) others.push_back(other);
  try {
    has_closed_slopes_ = evaluator_.has_slopes(settings(at), others, wanted_);
  } catch (const InputError&) {
    has_closed_slopes_ = false;  // the first fit tells what is wrong
  }
}

void StudyFit::check_produced() {
  // The solution at the start is that of the first fit, too.
  if (has_closed_slopes_ && closed_slopes(objective_->parameters(start_))) return;
  evaluator_.require_produced(wanted_);
}

std::optional<ModelSlopes> StudyFit::closed_slopes(const VectorXd& parameters) {
  {
    const std::scoped_lock lock(mutex_);
    for (const auto& [place, known] : known_)
      if (place == parameters) return known;
  }
  std::optional<ModelSlopes> found;
  // To the other side where the study or the mesh refuses one.
  for (const double direction : {1.0, -1.0}) {
    try {
      FigureSlopes slopes =
          evaluator_.slopes(settings(parameters), moved(parameters, direction), wanted_);
      found = ModelSlopes{std::move(slopes.values), std::move(slopes.derivatives)};
      break;
    } catch (const InputError&) {
      continue;
    }
  }
  if (!found) return std::nullopt;  // as of a mesh of another topology
  constexpr std::size_t kKept = 64;
  const std::scoped_lock lock(mutex_);
  if (known_.size() == kKept) known_.erase(known_.begin());
  known_.emplace_back(parameters, *found);
  return found;
}

ModelSlopes StudyFit::slopes(const VectorXd& parameters) {
  if (has_closed_slopes_)
    if (std::optional<ModelSlopes> found = closed_slopes(parameters)) return *found;
  return differences_(parameters);
}

VectorXd StudyFit::values(const VectorXd& parameters) {
  if (has_closed_slopes_)
    if (const std::optional<ModelSlopes> found = closed_slopes(parameters)) return found->values;
  return observables(parameters);
}

}  // namespace flexneck::pipeline
