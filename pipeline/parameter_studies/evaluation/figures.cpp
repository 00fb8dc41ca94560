// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/parameter_studies/evaluation/figures.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <span>
#include <string_view>

#include "fe_modal/analysis/sensitivity.h"
#include "geometry/foundation/error.h"
#include "geometry/foundation/names.h"
#include "pipeline/experiments/verification/mode_rank.h"
#include "pipeline/laboratory/verdict/response_rules.h"

namespace flexneck::pipeline {

namespace {

constexpr std::string_view kFrequencyOf = "frequency.";
constexpr std::string_view kFrequencyByRank = "frequency_by_rank.";
constexpr std::string_view kStiffnessOf = "static_stiffness.";

/// Index of the load of a stiffness such as "Fx/ux at top": forces 0 to 2, moments 3 to 5.
std::size_t load_of(const std::string& stiffness) {
  const std::string here = stiffness.substr(std::min(stiffness.find(" at "), stiffness.size()));
  std::vector<std::string> names;
  const std::string interface = here.empty() ? "<interface>" : here.substr(4);
  for (std::size_t load = 0; load < 6; ++load)
    names.push_back(fe_modal::stiffness_name(load, interface));
  return find_name(names, stiffness, "static stiffness");
}

double static_stiffness(const fe_modal::ModalBody& body, const std::string& name) {
  const auto load = static_cast<Eigen::Index>(load_of(name));
  const fe_modal::Interface& at = body.interface(name.substr(name.find(" at ") + 4));
  if (!at.response)
    throw InputError("interface '" + at.name +
                     "' has no static stiffness: its nodes are fixed, "
                     "or the body is free");
  return 1 / at.response->compliance(load, load);
}

/// Kind and rank of a mode, such as "bending 2".
struct ModeRank {
  std::string kind;
  std::size_t rank = 0;  ///< rank counted from 1
};

ModeRank mode_rank(const std::string& text) {
  const std::size_t space = text.rfind(' ');
  const std::string number = space == std::string::npos ? "" : text.substr(space + 1);
  ModeRank found{text.substr(0, space), 0};
  std::from_chars(number.data(), number.data() + number.size(), found.rank);
  if (found.rank < 1 || std::to_string(found.rank) != number)
    throw InputError("expected a kind of mode and its rank such as \"bending 2\", found \"" + text +
                     "\"");
  find_name(mode_kinds(), found.kind, "kind of mode");
  return found;
}

/// Row of a list of figures; the list is the only definition of the available figures.
template <class Result>
struct Row {
  std::string name;
  const char* unit;
  ResultValue (*read)(const Result&);
  PendulumSource source = PendulumSource::channels;
};

template <class Rows>
const auto& row_named(const Rows& rows, const std::string& name) {
  std::vector<std::string> names;
  for (const auto& row : rows) names.push_back(row.name);
  return rows[find_name(names, name, "figure")];
}

ResultValue known(double value) { return {value, {}}; }

template <multibody::Peak PendulumResult::*peak>
ResultValue value_of(const PendulumResult& result) {
  return known((result.*peak).value);
}

template <multibody::Peak PendulumResult::*peak>
ResultValue time_of(const PendulumResult& result) {
  return known((result.*peak).time_s);
}

template <std::optional<double> PendulumResult::*figure>
ResultValue oscillation(const PendulumResult& result) {
  return {result.*figure, "the head does not swing back and forth for long enough"};
}

template <double multibody::SystemMode::*figure>
ResultValue mode_figure(const multibody::SystemMode& mode) {
  return known(mode.*figure);
}

template <double StaticTestResult::*figure>
ResultValue test_figure(const StaticTestResult& result) {
  return known(result.*figure);
}

std::span<const Row<PendulumResult>> pendulum_rows() {
  using R = PendulumResult;
  constexpr auto kFiltered = PendulumSource::filtered_channels;
  static const std::array<Row<R>, 13> rows = {{
      {"head_rotation", "rad", value_of<&R::head_rotation>},
      {"head_rotation_time", "s", time_of<&R::head_rotation>},
      {"neck_rotation", "rad", value_of<&R::neck_rotation>},
      {"neck_rotation_time", "s", time_of<&R::neck_rotation>},
      {"base_moment", "N*m", value_of<&R::base_moment>},
      {"base_moment_time", "s", time_of<&R::base_moment>},
      {"occipital_moment", "N*m", value_of<&R::occipital_moment>},
      {"occipital_moment_time", "s", time_of<&R::occipital_moment>},
      {"head_acceleration", "m/s^2", value_of<&R::head_acceleration>, kFiltered},
      {"head_acceleration_time", "s", time_of<&R::head_acceleration>, kFiltered},
      {"zero_crossing", "s", oscillation<&R::zero_crossing_s>},
      {"run_frequency", "Hz", oscillation<&R::run_frequency_Hz>},
      {"run_damping_ratio", "1", oscillation<&R::run_damping_ratio>},
  }};
  return rows;
}

std::span<const Row<multibody::SystemMode>> system_rows() {
  using M = multibody::SystemMode;
  static const std::array<Row<M>, 2> rows = {{
      {kSystemFrequency, "Hz", mode_figure<&M::frequency_Hz>, PendulumSource::system_mode},
      {"system_damping_ratio", "1", mode_figure<&M::damping_ratio>, PendulumSource::system_mode},
  }};
  return rows;
}

std::span<const Row<StaticTestResult>> static_rows() {
  using R = StaticTestResult;
  static const std::array<Row<R>, 5> rows = {{
      {"rotation", "rad", test_figure<&R::rotation>},
      {"base_moment", "N*m", test_figure<&R::base_moment>},
      {"deflection", "m", test_figure<&R::deflection>},
      {"initial_stiffness", "N*m/rad", test_figure<&R::initial_stiffness>},
      {"final_stiffness", "N*m/rad", test_figure<&R::final_stiffness>},
  }};
  return rows;
}

bool is_system_figure(const std::string& name) {
  const auto rows = system_rows();
  return std::any_of(rows.begin(), rows.end(), [&](const auto& row) { return row.name == name; });
}

std::string with_underscores(std::string name) {
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
}

constexpr const char* kInside = "figures_inside";

/// Figures with the names of the rules, evaluated for a head at rest.
std::vector<JudgedFigure> figures_at_rest(const CertificationTest& test) {
  const Eigen::VectorXd rest = Eigen::VectorXd::Zero(3);
  return judged_response(test, {Eigen::VectorXd::LinSpaced(3, 0, 1), rest, rest});
}

std::size_t place_of(const std::vector<JudgedFigure>& figures, const std::string& name) {
  std::vector<std::string> names;
  names.reserve(figures.size());
  for (const JudgedFigure& each : figures) names.push_back(with_underscores(each.name));
  return find_name(names, with_underscores(name), "figure");
}

}  // namespace

std::string unit_of_modes_figure(const std::string& name) {
  if (name.starts_with(kFrequencyOf) && name.size() > kFrequencyOf.size()) return "Hz";
  if (name.starts_with(kFrequencyByRank)) {
    mode_rank(name.substr(kFrequencyByRank.size()));
    return "Hz";
  }
  if (is_stiffness_figure(name)) return load_of(stiffness_of_figure(name)) < 3 ? "N/m" : "N*m/rad";
  const std::vector<std::string> names = {kMass, kSystemFrequency, "frequency.<mode>",
                                          "frequency_by_rank.<kind> <rank>",
                                          "static_stiffness.<load>/<motion> at <interface>"};
  return find_name(names, name, "figure") == 0 ? "kg" : "Hz";
}

std::size_t mode_of_figure(const fe_modal::ModalBody& body, const std::string& name) {
  if (!name.starts_with(kFrequencyByRank))
    return static_cast<std::size_t>(body.mode_index(name.substr(kFrequencyOf.size())));
  const ModeRank asked = mode_rank(name.substr(kFrequencyByRank.size()));
  const std::vector<std::size_t> modes = modes_of_kind(body, asked.kind);
  if (asked.rank > modes.size())
    throw InputError("expected a mode among those computed, found " + std::to_string(modes.size()) +
                     " of kind " + asked.kind + "; increase modes.count");
  return modes[asked.rank - 1];
}

bool is_stiffness_figure(const std::string& name) { return name.starts_with(kStiffnessOf); }
std::string stiffness_of_figure(const std::string& name) {
  return name.substr(kStiffnessOf.size());
}

double modes_figure(const fe_modal::ModalBody& body, const std::string& name) {
  if (name == kMass) return body.invariants.mass;
  if (is_stiffness_figure(name)) return static_stiffness(body, stiffness_of_figure(name));
  if (name != kSystemFrequency)
    return body.frequencies_Hz[static_cast<Eigen::Index>(mode_of_figure(body, name))];
  if (body.attached.empty())
    throw InputError("expected modes.attached_body, found none: there is no system frequency");
  return body.attached.front().frequencies_Hz[0];
}

std::string unit_of_pendulum_figure(const std::string& name) {
  if (is_system_figure(name)) return row_named(system_rows(), name).unit;
  std::vector<std::string> names;
  for (const auto& row : pendulum_rows()) names.push_back(row.name);
  for (const auto& row : system_rows()) names.push_back(row.name);
  find_name(names, name, "figure");
  return row_named(pendulum_rows(), name).unit;
}

PendulumSource source_of_pendulum_figure(const std::string& name) {
  return is_system_figure(name) ? PendulumSource::system_mode
                                : row_named(pendulum_rows(), name).source;
}

ResultValue pendulum_figure(const PendulumResult& result, const std::string& name) {
  return row_named(pendulum_rows(), name).read(result);
}

ResultValue system_figure(const multibody::SystemMode& mode, const std::string& name) {
  if (!mode.kink.empty()) return {{}, "small motions meet a kink, " + mode.kink};
  return row_named(system_rows(), name).read(mode);
}

std::string unit_of_static_figure(const std::string& name) {
  return row_named(static_rows(), name).unit;
}

double static_figure(const StaticTestResult& result, const std::string& name) {
  return *row_named(static_rows(), name).read(result).value;
}

std::string unit_of_verdict_figure(const std::string& name, const CertificationTest& test) {
  if (name == kInside) return "1";
  const std::vector<JudgedFigure> figures = figures_at_rest(test);
  return figures[place_of(figures, name)].unit;
}

ResultValue verdict_figure(const Verdict& verdict, const std::string& name) {
  if (name == kInside) return known(static_cast<double>(verdict.passed_count()));
  const JudgedFigure& figure = verdict.figures[place_of(verdict.figures, name)];
  return {figure.value, figure.problem};
}

}  // namespace flexneck::pipeline
