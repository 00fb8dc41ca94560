// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/parameter_studies/fit/study_fit.h"

#include <tuple>
#include <utility>

#include <fmt/core.h>

#include "geometry/foundation/error.h"
#include "geometry/foundation/names.h"
#include "geometry/foundation/units.h"
#include "pipeline/language/document/product_text.h"
#include "pipeline/language/model/model_sections.h"
#include "pipeline/parameter_studies/fit/curve_terms.h"
#include "pipeline/parameter_studies/fit/target_terms.h"

namespace flexneck::pipeline {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

StudyFit::StudyFit(Evaluator& evaluator, FitSection section, unsigned threads)
    : evaluator_(evaluator),
      section_(std::move(section)),
      expressions_(names_of(section_.parameters)) {
  std::vector<FitTerm> all = terms();
  check_parameters();
  const auto plain = [this](const VectorXd& at) { return observables(at); };
  const auto of_others = [this](const VectorXd& at) {
    return others_.observables(evaluator_, settings(at));
  };
  differences_ = central_differences(plain, ranges(), threads);
  differences_of_others_ = central_differences(of_others, ranges(), threads);
  differences_of_expressions_ =
      central_differences([this](const VectorXd& at) { return expressions_.values(at); }, ranges());
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
  check_varied(evaluator_, all, all_.wanted(), "fit", "the targets");
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
          fmt::format("expected bounds that contain the start, found {:g} to {:g} and the study's "
                      "value {}; widen the bounds, or give start",
                      each.from, each.to, found->value));
  }
  start_ = objective_->place(at);
}

void StudyFit::add_observed(const FitTarget& target, const OutputName& output, std::size_t first,
                            std::size_t count) {
  const auto row = static_cast<Index>(first);
  const auto rows = static_cast<Index>(count);
  all_.add(target, output, row, rows);
  if (!target.curve && output.of == OutputName::Of::modes)
    of_modes_.add(target, output, row, rows);
  else if (!target.is_held_out)
    others_.add(target, output, row, rows);
}

void StudyFit::add_figure_terms(const FitTarget& target, std::vector<FitTerm>& terms) {
  const OutputName output = at_key(target.table, "output", [&] {
    return evaluator_.wanted({target.output}, {}).figures.front();
  });
  add_observed(target, output, terms.size(), 1);
  const std::string si_unit = unit_of(output, evaluator_.base());
  terms.push_back(target.is_window() ? window_term(target, si_unit) : value_term(target, si_unit));
  const auto [unit, factor] = unit_of_text(text_with_unit(target), si_unit);
  targets_.push_back({target.name, target.output, unit, factor, wanted_text(target), {}});
}

void StudyFit::add_curve_terms(const FitTarget& target, std::vector<FitTerm>& terms) {
  const FitCurve& curve = *target.curve;
  const OutputName output = at_key(
      target.table, "curve", [&] { return evaluator_.wanted({}, {curve.output}).curves.front(); });
  const double end_s = case_of(output, evaluator_.base()).duration_s;
  if (curve.from_s < 0 || curve.to_s > end_s)
    target.table.refuse("to", fmt::format("expected times within the case, 0 s to {:g} s, found "
                                          "{:g} s to {:g} s",
                                          end_s, curve.from_s, curve.to_s));
  const std::string si_unit = unit_of_curve(output);
  const std::vector<FitTerm> of_curve = curve_terms(target, si_unit);
  add_observed(target, output, terms.size(), of_curve.size());
  terms.insert(terms.end(), of_curve.begin(), of_curve.end());
  std::string unit = "1";
  double factor = 1;
  if (curve.corridor) {
    unit = curve.corridor->lower.unit;
    factor = factor_from_si(si_unit, unit);
  } else if (!curve.rating) {
    std::tie(unit, factor) = unit_of_text(text_with_unit(target), si_unit);
  }
  targets_.push_back({target.name, curve.output, unit, factor, wanted_text(target), {}});
}

void StudyFit::add_expression_term(const FitTarget& target, std::vector<FitTerm>& terms) {
  at_key(target.table, "expression",
         [&] { expressions_.add(target.expression, static_cast<Index>(terms.size())); });
  terms.push_back(target.is_window() ? window_term(target, "1") : value_term(target, "1"));
  targets_.push_back({target.name, target.expression, "1", 1, wanted_text(target), {}});
}

std::vector<FitTerm> StudyFit::terms() {
  std::vector<FitTerm> all;
  for (const FitTarget& each : section_.targets) {
    if (each.curve)
      add_curve_terms(each, all);
    else if (each.expression.empty())
      add_figure_terms(each, all);
    else
      add_expression_term(each, all);
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

bool StudyFit::is_accepted(const VectorXd& parameters) {
  try {
    static_cast<void>(study(parameters));
    return true;
  } catch (const InputError&) {
    return false;
  }
}

VectorXd StudyFit::observables(const VectorXd& parameters) {
  VectorXd all(static_cast<Index>(all_.rows().size() + expressions_.rows().size()));
  all(all_.rows()) = all_.observables(evaluator_, settings(parameters));
  all(expressions_.rows()) = expressions_.values(parameters);
  return all;
}

StudyFit::Moved StudyFit::moved(const VectorXd& parameters, double direction) const {
  constexpr double kStep = 1e-3;  // fraction of the range
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
    has_closed_slopes_ = evaluator_.has_slopes(settings(at), others, of_modes_.wanted());
  } catch (const InputError&) {
    has_closed_slopes_ = false;  // the first fit reports the error
  }
}

std::string StudyFit::slopes_text() const {
  if (!has_closed_slopes_) return "by finite differences";
  return others_.is_empty() ? "in closed form"
                            : "in closed form for modes, otherwise by finite differences";
}

void StudyFit::check_produced() {
  // The first fit needs the solution at the start, too.
  if (has_closed_slopes_ && closed_slopes(objective_->parameters(start_))) return;
  evaluator_.require_produced(all_.wanted());
}

std::optional<ModelSlopes> StudyFit::closed_slopes(const VectorXd& parameters) {
  {
    const std::scoped_lock lock(mutex_);
    for (const auto& [place, known] : known_)
      if (place == parameters) return known;
  }
  std::optional<ModelSlopes> found;
  // The other direction is tried if the study or the mesh refuses one.
  for (const double direction : {1.0, -1.0}) {
    try {
      FigureSlopes slopes =
          evaluator_.slopes(settings(parameters), moved(parameters, direction), of_modes_.wanted());
      found = ModelSlopes{std::move(slopes.values), std::move(slopes.derivatives)};
      break;
    } catch (const InputError&) {
      continue;
    }
  }
  if (!found) return std::nullopt;  // for instance if the mesh has another topology
  constexpr std::size_t kKept = 64;
  const std::scoped_lock lock(mutex_);
  if (known_.size() == kKept) known_.erase(known_.begin());
  known_.emplace_back(parameters, *found);
  return found;
}

ModelSlopes StudyFit::slopes(const VectorXd& parameters) {
  const std::optional<ModelSlopes> closed =
      has_closed_slopes_ ? closed_slopes(parameters) : std::nullopt;
  if (!closed) return differences_(parameters);
  const auto terms = static_cast<Index>(objective_->terms().size());
  // Terms that are held out need no slopes.
  ModelSlopes all{VectorXd::Zero(terms), MatrixXd::Zero(terms, parameters.size())};
  const auto put = [&](const ModelSlopes& some, const auto& of) {
    all.values(of.rows()) = some.values;
    all.derivatives(of.rows(), Eigen::all) = some.derivatives;
  };
  put(*closed, of_modes_);
  if (!others_.is_empty()) put(differences_of_others_(parameters), others_);
  if (!expressions_.rows().empty()) put(differences_of_expressions_(parameters), expressions_);
  return all;
}

VectorXd StudyFit::values(const VectorXd& parameters) {
  // All targets are of the modes: the fit asks for slopes at the same place next.
  if (has_closed_slopes_ && of_modes_.rows().size() == all_.rows().size()) {
    if (const std::optional<ModelSlopes> found = closed_slopes(parameters)) {
      VectorXd all(static_cast<Index>(objective_->terms().size()));
      all(of_modes_.rows()) = found->values;
      all(expressions_.rows()) = expressions_.values(parameters);
      return all;
    }
  }
  return observables(parameters);
}

}  // namespace flexneck::pipeline
