// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/results/report/curves.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "pipeline/process/customary_units.h"
#include "pipeline/results/plotting/embedding.h"
#include "pipeline/results/report/corridors.h"
#include "pipeline/results/report/display_units.h"
#include "pipeline/results/tables/measured_tables.h"

namespace flexneck::pipeline {

using Json = nlohmann::ordered_json;

namespace {

const char* name_of(Experiment::Kind kind) {
  return kind == Experiment::Kind::pendulum ? "pendulum" : "static";
}

Json channels_json(const Experiment& experiment, Eigen::Index stride) {
  Json channels = Json::array();
  for (const multibody::Channel& channel : experiment.file.channels) {
    for (Eigen::Index row = 0; row < channel.values.rows(); ++row) {
      const bool is_one = channel.values.rows() == 1;
      const std::string& column = channel.columns[static_cast<std::size_t>(row)];
      const Eigen::RowVectorXd values =
          channel.values(row, Eigen::seq(0, channel.values.cols() - 1, stride));
      channels.push_back({{"name", is_one ? channel.name : channel.name + " " + column},
                          {"unit", channel.unit},
                          {"filter", channel.filter},
                          {"values", base64_floats(values)}});
    }
  }
  return channels;
}

/// Curves of a run, thinned: every value shown is one of the file's.
Json run_json(const Experiment& experiment, Eigen::Index most_samples) {
  const Eigen::VectorXd& time_s = experiment.file.history.time_s;
  const Eigen::Index stride = (time_s.size() + most_samples - 1) / most_samples;
  const Eigen::VectorXd shown = time_s(Eigen::seq(0, time_s.size() - 1, stride));
  return {{"name", experiment.name},
          {"kind", name_of(experiment.kind)},
          {"every", stride},
          {"times", base64_floats(shown)},
          {"channels", channels_json(experiment, stride)}};
}

/// Display units for each kind of experiment and SI unit, in both systems.
Json units_json(const Results& results) {
  Json units = {{"pendulum", Json::object()}, {"static", Json::object()}};
  for (const Experiment& experiment : results.experiments)
    for (const multibody::Channel& channel : experiment.file.channels)
      units[name_of(experiment.kind)][channel.unit] =
          display_unit(channel.unit, shown_unit(channel.unit, experiment.kind));
  return units;
}

const Experiment* run_of(const Results& results, const std::string& name) {
  const auto found =
      std::find_if(results.experiments.begin(), results.experiments.end(),
                   [&](const Experiment& experiment) { return experiment.name == name; });
  return found == results.experiments.end() ? nullptr : &*found;
}

/// Measured curves as runs of the case with one channel each, named "<case>-<test>".
Json measured_json(const Results& results, const Study& study) {
  Json runs = Json::array();
  for (const MeasuredTest& test : study.measured) {
    const Experiment* const experiment = run_of(results, test.experiment);
    if (experiment == nullptr) continue;
    for (const MeasuredCurve& measured : test.curves) {
      const Curve computed = computed_curve(experiment->file, measured.channel);
      const Curve curve = in_unit(measured.curve, computed.unit);
      runs.push_back({{"name", test.experiment + "-" + test.name},
                      {"kind", name_of(experiment->kind)},
                      {"times", base64_floats(curve.time_s)},
                      {"channels", Json::array({{{"name", measured.channel},
                                                 {"unit", curve.unit},
                                                 {"filter", ""},
                                                 {"values", base64_floats(curve.values)}}})}});
    }
  }
  return runs;
}

/// Measured corridors as bands between a lower and an upper curve.
Json bands_json(const Results& results, const Study& study) {
  Json bands = Json::array();
  for (const MeasuredTest& test : study.measured) {
    const Experiment* const experiment = run_of(results, test.experiment);
    if (experiment == nullptr) continue;
    for (const MeasuredCorridor& corridor : test.corridors) {
      const std::string unit = computed_curve(experiment->file, corridor.channel).unit;
      bands.push_back({{"case", test.experiment},
                       {"channel", corridor.channel},
                       {"what", test.name},
                       {"unit", unit},
                       {"times", base64_floats(corridor.lower.time_s)},
                       {"lower", base64_floats(in_unit(corridor.lower, unit).values)},
                       {"upper", base64_floats(in_unit(corridor.upper, unit).values)}});
    }
  }
  return bands;
}

Json corridors_json(const Study& study) {
  Json list = Json::array();
  for (const Corridor& corridor : corridors_of(study)) {
    list.push_back({{"case", corridor.experiment},
                    {"channel", corridor.channel},
                    {"what", corridor.what},
                    {"unit", corridor.unit},
                    {"times", {corridor.times_s.low, corridor.times_s.high}},
                    {"values", {corridor.values.low, corridor.values.high}}});
  }
  return list;
}

}  // namespace

std::string shown_unit(const std::string& si_unit, Experiment::Kind kind) {
  return customary_unit(si_unit, kind == Experiment::Kind::pendulum ? "lbf*ft" : "in*lbf");
}

Json curves_of(const Results& results, const Study& study, Eigen::Index most_samples) {
  Json runs = Json::array();
  for (const Experiment& experiment : results.experiments) {
    if (!experiment.file.channels.empty()) runs.push_back(run_json(experiment, most_samples));
  }
  if (runs.empty()) return nullptr;
  return {{"runs", std::move(runs)},
          {"units", units_json(results)},
          {"corridors", corridors_json(study)},
          {"measured", measured_json(results, study)},
          {"bands", bands_json(results, study)}};
}

}  // namespace flexneck::pipeline
