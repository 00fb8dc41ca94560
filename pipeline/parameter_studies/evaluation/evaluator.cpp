// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/parameter_studies/evaluation/evaluator.h"

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

#include "geometry/foundation/error.h"
#include "geometry/foundation/names.h"
#include "pipeline/experiments/case_model.h"
#include "pipeline/experiments/pendulum_signals.h"
#include "pipeline/experiments/test_curves.h"
#include "pipeline/laboratory/verdict/verdict.h"
#include "pipeline/parameter_studies/evaluation/figures.h"
#include "pipeline/parameter_studies/evaluation/pieces_of_cases.h"

namespace flexneck::pipeline {

namespace {

using Of = OutputName::Of;

bool is_unfiltered(const std::string& channel) {
  return has_channel(unfiltered_channels({}), channel);
}

/// Runs of the pendulum that are wanted, each computed once.
class Experiments {
 public:
  Experiments(const Study& study, BodyCache& bodies, const WantedOutputs& wanted)
      : study_(study), bodies_(bodies) {
    for (const OutputName& each : wanted.figures) note(each, needs_filter(each));
    for (const OutputName& each : wanted.curves) note(each, !is_unfiltered(each.figure));
  }

  ResultValue figure(const OutputName& output) {
    switch (output.of) {
      case Of::modes:
        return {modes_figure(*body_for(output), output.figure), {}};
      case Of::pendulum:
        return of_pendulum(output);
      case Of::static_test:
        return {static_figure(static_result(case_of(output, study_)), output.figure), {}};
      case Of::verdict:
        return of_verdict(output);
    }
    return {};
  }

  void add_curve(const OutputName& output, Evaluation& evaluation) {
    const PendulumRun& of_case = run(case_of(output, study_));
    evaluation.curves.push_back(channel_named(of_case.channels, output.figure));
    evaluation.times_s.push_back(of_case.history.time_s);
  }

 private:
  static bool needs_filter(const OutputName& output) {
    if (output.of == Of::verdict) return true;
    return output.of == Of::pendulum &&
           source_of_pendulum_figure(output.figure) == PendulumSource::filtered_channels;
  }

  void note(const OutputName& output, bool is_filtered) {
    if (output.of == Of::pendulum || output.of == Of::verdict)
      is_filtered_[case_of(output, study_).name] |= is_filtered;
  }

  const BodyCache::Body& body() {
    if (!body_) body_ = bodies_.body(study_, BodyUse::experiments);
    return body_;
  }

  /// Modes for a case; none are computed if all its bodies are rigid.
  const fe_modal::ModalBody& body_of(const CaseSection& experiment) {
    static const fe_modal::ModalBody kNone;
    const bool is_rigid = experiment.model.of_structure.empty();
    return is_rigid && !experiment.equivalent_rigid_neck ? kNone : *body();
  }

  BodyCache::Body body_for(const OutputName& output) {
    return is_of_attached(output) ? bodies_.body(study_, BodyUse::attached) : body();
  }

  const PendulumRun& run(const CaseSection& experiment) {
    const auto known = runs_.find(experiment.name);
    if (known != runs_.end()) return known->second;
    PendulumRun found = is_filtered_[experiment.name]
                            ? run_pendulum(study_, experiment, body_of(experiment))
                            : run_pendulum_unfiltered(study_, experiment, body_of(experiment));
    if (!found.history.incomplete.empty())
      throw ComputationError(experiment.name + ": " + found.history.incomplete);
    return runs_.emplace(experiment.name, std::move(found)).first->second;
  }

  ResultValue of_pendulum(const OutputName& output) {
    const CaseSection& experiment = case_of(output, study_);
    if (source_of_pendulum_figure(output.figure) == PendulumSource::system_mode) {
      auto known = modes_.find(experiment.name);
      if (known == modes_.end())
        known = modes_
                    .emplace(experiment.name,
                             first_system_mode(study_, experiment, body_of(experiment), true))
                    .first;
      return system_figure(known->second, output.figure);
    }
    auto known = results_.find(experiment.name);
    if (known == results_.end()) {
      const PendulumRun& of_case = run(experiment);
      known = results_
                  .emplace(
                      experiment.name,
                      pendulum_result(study_, experiment, of_case.history.time_s, of_case.channels))
                  .first;
    }
    return pendulum_figure(known->second, output.figure);
  }

  const StaticTestResult& static_result(const CaseSection& experiment) {
    const auto known = static_results_.find(experiment.name);
    if (known != static_results_.end()) return known->second;
    const BodyCache::Body of_tests =
        study_.has_static_moduli() ? bodies_.body(study_, BodyUse::static_tests) : body();
    const multibody::Model model = case_model(experiment, *of_tests);
    const StaticTestResult found = static_test_result(
        static_test_signals(model, settled_static_test(study_, experiment, model), experiment));
    return static_results_.emplace(experiment.name, found).first->second;
  }

  ResultValue of_verdict(const OutputName& output) {
    const TestSection& test = test_of(output, study_);
    const CaseSection& experiment = case_of(output, study_);
    const PendulumRun& of_case = run(experiment);
    return verdict_figure(judged(test.rules, test_curves(study_, test, experiment,
                                                         of_case.history.time_s, of_case.channels)),
                          output.figure);
  }

  const Study& study_;
  BodyCache& bodies_;
  BodyCache::Body body_;
  std::map<std::string, bool> is_filtered_;  ///< true for cases whose filtered channels are wanted
  std::map<std::string, PendulumRun> runs_;
  std::map<std::string, PendulumResult> results_;
  std::map<std::string, multibody::SystemMode> modes_;
  std::map<std::string, StaticTestResult> static_results_;
};

std::string unit_of_known(const OutputName& output, const Study& study) {
  switch (output.of) {
    case Of::modes:
      return unit_of_modes_figure(output.figure);
    case Of::pendulum:
      return unit_of_pendulum_figure(output.figure);
    case Of::static_test:
      return unit_of_static_figure(output.figure);
    case Of::verdict:
      return unit_of_verdict_figure(output.figure, test_of(output, study).rules);
  }
  return {};
}

[[noreturn]] void refuse(const OutputName& output, const std::string& problem) {
  throw InputError("output '" + output.text + "': " + problem);
}

void check_curve(const OutputName& output) {
  if (output.of != Of::pendulum)
    refuse(output, "expected a curve of the pendulum, such as pendulum.<case>.head rotation");
  try {
    static_cast<void>(unit_of_curve(output));
  } catch (const InputError& error) {
    refuse(output, error.what());
  }
}

}  // namespace

std::string unit_of_curve(const OutputName& output) {
  const std::vector<multibody::Channel> unfiltered = unfiltered_channels({});
  std::vector<std::string> names = names_of(unfiltered);
  names.insert(names.end(), {kFilteredHeadAcceleration, kLoadCellMoment});
  const std::size_t place = find_name(names, output.figure, "channel");
  if (place < unfiltered.size()) return unfiltered[place].unit;
  return names[place] == kLoadCellMoment ? "N*m" : "m/s^2";
}

std::string unit_of(const OutputName& output, const Study& study) {
  try {
    return unit_of_known(output, study);
  } catch (const InputError& error) {
    refuse(output, error.what());
  }
}

Evaluator::Evaluator(StudyChoice base, const Console& console)
    : choice_(std::move(base)),
      base_(read_study(choice_.study, choice_.settings)),
      bodies_(console) {}

WantedOutputs Evaluator::wanted(const std::vector<std::string>& figures,
                                const std::vector<std::string>& curves) const {
  WantedOutputs found;
  for (const std::string& each : figures) {
    found.figures.push_back(output_name(each, base_));
    static_cast<void>(unit_of(found.figures.back(), base_));
  }
  for (const std::string& each : curves) {
    found.curves.push_back(output_name(each, base_));
    check_curve(found.curves.back());
  }
  return found;
}

void Evaluator::require_produced(const WantedOutputs& wanted) {
  for (const OutputName& each : wanted.figures) {
    if (each.of != Of::modes || each.figure == "mass") continue;
    try {
      const BodyUse use = is_of_attached(each) ? BodyUse::attached : BodyUse::experiments;
      static_cast<void>(modes_figure(*bodies_.body(base_, use), each.figure));
    } catch (const InputError& error) {
      refuse(each, error.what());
    }
  }
}

Study Evaluator::study(const std::vector<std::string>& settings) {
  std::unique_ptr<StudyReader> reader;
  {
    const std::scoped_lock lock(mutex_);
    if (!idle_readers_.empty()) {
      reader = std::move(idle_readers_.back());
      idle_readers_.pop_back();
    }
  }
  if (!reader) reader = std::make_unique<StudyReader>(choice_.study, choice_.settings);
  Study found = reader->read(settings);  // a reader that throws is discarded
  const std::scoped_lock lock(mutex_);
  has_study_changed_ = has_study_changed_ || found.files != base_.files;
  idle_readers_.push_back(std::move(reader));
  return found;
}

void Evaluator::require_same_study() const {
  const std::scoped_lock lock(mutex_);
  if (has_study_changed_)
    throw InputError(
        base_.file.string() +
        ": the file or one that it includes was changed during the run; run the command again");
}

Evaluation Evaluator::evaluate(const std::vector<std::string>& settings,
                               const WantedOutputs& wanted) {
  Study found = study(settings);
  if (has_cases_of_pieces(found)) {
    const BodyCache::StructurePieces pieces = bodies_.pieces(found);
    found = with_pieces(std::move(found), *pieces);
  }
  Experiments experiments(found, bodies_, wanted);
  Evaluation evaluation;
  evaluation.figures.resize(static_cast<Eigen::Index>(wanted.figures.size()));
  for (std::size_t k = 0; k < wanted.figures.size(); ++k) {
    const ResultValue figure = experiments.figure(wanted.figures[k]);
    evaluation.figures[static_cast<Eigen::Index>(k)] =
        figure.value.value_or(std::numeric_limits<double>::quiet_NaN());
    if (!figure.value && evaluation.problem.empty())
      evaluation.problem = wanted.figures[k].text + ": " + figure.problem;
  }
  for (const OutputName& each : wanted.curves) experiments.add_curve(each, evaluation);
  return evaluation;
}

bool Evaluator::has_slopes(const std::vector<std::string>& settings,
                           const std::vector<std::vector<std::string>>& moved,
                           const WantedOutputs& wanted) {
  const auto is_of_modes = [](const OutputName& each) { return each.of == Of::modes; };
  if (wanted.figures.empty() || !wanted.curves.empty() || !has_modes_slopes(base_) ||
      !std::all_of(wanted.figures.begin(), wanted.figures.end(), is_of_modes))
    return false;
  const Study at = study(settings);
  return std::all_of(moved.begin(), moved.end(), [&](const std::vector<std::string>& other) {
    return differ_in_mesh_only(at, study(other));
  });
}

FigureSlopes Evaluator::slopes(
    const std::vector<std::string>& settings,
    const std::vector<std::pair<std::vector<std::string>, double>>& moved,
    const WantedOutputs& wanted) {
  std::vector<MovedStudy> others;
  others.reserve(moved.size());
  for (const auto& [other, width] : moved) others.push_back({study(other), width});
  std::vector<std::string> figures;
  BodyUse use = BodyUse::experiments;
  for (const OutputName& each : wanted.figures) {
    figures.push_back(each.figure);
    if (is_of_attached(each)) use = BodyUse::attached;
  }
  return bodies_.slopes(study(settings), use, others, figures);
}

}  // namespace flexneck::pipeline
