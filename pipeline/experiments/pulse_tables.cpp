// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/experiments/pulse_tables.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <set>
#include <utility>

#include <fmt/core.h>

#include "geometry/foundation/names.h"
#include "geometry/foundation/units.h"
#include "pipeline/language/study/drop.h"
#include "pipeline/language/study/origins.h"

namespace flexneck::pipeline {

namespace {

using Complex = std::complex<double>;

/// Moments int u^n exp(-z u) du over [0, 1].
struct Moments {
  Complex zeroth, first;
};

Moments moments(Complex z) {
  // For smaller |z| the closed form loses more to cancellation than the truncated series.
  constexpr double kSmall = 1e-3;
  if (std::abs(z) < kSmall)
    return {1.0 - z / 2.0 + z * z / 6.0 - z * z * z / 24.0,
            0.5 - z / 3.0 + z * z / 8.0 - z * z * z / 30.0};
  const Complex decay = std::exp(-z);
  return {(1.0 - decay) / z, (1.0 - decay * (1.0 + z)) / (z * z)};
}

}  // namespace

Complex fourier_transform(const std::vector<double>& times_s, const std::vector<double>& values,
                          double frequency_Hz) {
  const Complex s(0, 2 * std::numbers::pi * frequency_Hz);
  Complex sum = 0;
  for (std::size_t k = 0; k + 1 < times_s.size(); ++k) {
    const double h = times_s[k + 1] - times_s[k];
    const Moments m = moments(s * h);
    sum += std::exp(-s * times_s[k]) * h *
           (values[k] * m.zeroth + (values[k + 1] - values[k]) * m.first);
  }
  return sum;
}

namespace {

/// Length of the point pendulum that a velocity implies; none without a drop angle.
std::optional<double> implied_length(const CaseSection& experiment) {
  if (!experiment.drop_angle_rad) return {};
  return drop_length(experiment.impact_velocity_m_s, *experiment.drop_angle_rad);
}

std::string in_inches(double length_m) {
  return fmt::format("{:.2f}", length_m * factor_from_si("m", "in"));
}

/// Length rounded to a hundredth of an inch, the accuracy that a velocity of three digits implies.
double rounded(double length_m) {
  const double hundredths = 100 * factor_from_si("m", "in");
  return std::round(length_m * hundredths) / hundredths;
}

/// Lengths implied by the velocities that are given.
std::set<double> lengths_given(const std::vector<PendulumEntry>& entries) {
  std::set<double> lengths_m;
  for (const PendulumEntry& entry : entries)
    if (entry.experiment.velocity_is_given && entry.experiment.drop_angle_rad)
      lengths_m.insert(rounded(*implied_length(entry.experiment)));
  return lengths_m;
}

/// False for a variant with the pulse of its base case, which needs no line of its own.
bool has_own_pulse(const PendulumEntry& entry, const std::vector<PendulumEntry>& entries) {
  return std::none_of(entries.begin(), entries.end(), [&](const PendulumEntry& base) {
    return base.experiment.name == entry.experiment.variant_of &&
           base.experiment.pulse == entry.experiment.pulse &&
           base.pulse.amplitude_factor == entry.pulse.amplitude_factor &&
           base.pulse.duration_factor == entry.pulse.duration_factor;
  });
}

double largest_deceleration_m_s2(const FittedPulse& pulse) {
  return *std::max_element(pulse.deceleration_m_s2.begin(), pulse.deceleration_m_s2.end());
}

std::vector<std::string> pulse_cells(const PendulumEntry& entry) {
  const double in = factor_from_si("m", "in");
  const FittedPulse& pulse = entry.pulse;
  return {entry.experiment.pulse,
          fmt::format("{:.1f}", pulse.area_m_s * in),
          fmt::format("{:+.1f}", 100 * (pulse.area_m_s / entry.experiment.impact_velocity_m_s - 1)),
          fmt::format("{:.4f}", pulse.amplitude_factor),
          fmt::format("{:.4f}", pulse.duration_factor),
          fmt::format("{:.1f}", pulse.velocity_left_m_s * in),
          fmt::format("{:.2f}", largest_deceleration_m_s2(pulse) * factor_from_si("m/s^2", "gn")),
          fmt::format("{:.1f}", pulse.times_s.back() * 1e3)};
}

}  // namespace

ResultTable velocity_table(const std::vector<PendulumEntry>& entries) {
  const double in = factor_from_si("m", "in");
  const std::set<double> lengths_m = lengths_given(entries);
  ResultTable table;
  table.name = "velocities";
  table.title = "Head/neck pendulum, velocities and pulses";
  table.columns = {{"case", ""},
                   {"drop", "deg"},
                   {"velocity", "in/s"},
                   {"velocity from", ""},
                   {"implies length", "in"}};
  for (const double length_m : lengths_m)
    table.columns.push_back({"on " + in_inches(length_m) + " in", "in/s"});
  for (const auto& [name, unit] :
       std::vector<std::pair<const char*, const char*>>{{"pulse", ""},
                                                        {"its area", "in/s"},
                                                        {"against the velocity", "%"},
                                                        {"amplitude times", "1"},
                                                        {"duration times", "1"},
                                                        {"velocity left", "in/s"},
                                                        {"largest", "gn"},
                                                        {"ends", "ms"}})
    table.columns.push_back({name, unit});
  std::set<std::string> used;  // lengths as printed: each is listed once
  for (const PendulumEntry& entry : entries) {
    if (!has_own_pulse(entry, entries)) continue;
    const CaseSection& experiment = entry.experiment;
    if (!experiment.velocity_is_given) used.insert(in_inches(*experiment.effective_length_m));
    const std::optional<double> length = implied_length(experiment);
    std::vector<std::string> row = {
        experiment.name, text_of(experiment.drop_angle_rad, "{:.0f}", factor_from_si("rad", "deg")),
        fmt::format("{:.2f}", experiment.impact_velocity_m_s * in),
        experiment.velocity_is_given ? "the study" : "drop and length",
        length ? in_inches(*length) : "-"};
    for (const double length_m : lengths_m) {
      const std::optional<double>& angle = experiment.drop_angle_rad;
      row.push_back(angle ? fmt::format("{:.2f}", drop_velocity(length_m, *angle) * in) : "-");
    }
    const std::vector<std::string> cells = pulse_cells(entry);
    row.insert(row.end(), cells.begin(), cells.end());
    table.rows.push_back(std::move(row));
  }
  table.notes.emplace_back(
      "The paper reports only the lowest and the highest velocity of its drops." +
      std::string(lengths_m.size() < 2
                      ? ""
                      : " The velocities that the study gives with a drop angle imply different "
                        "lengths of a point pendulum, all of which are shown."));
  for (const std::string& length : used)
    table.notes.push_back(
        "Velocities that the study does not give are computed for a point pendulum with a length "
        "of " +
        length + " in.");
  for (const std::string& warning : pulse_warnings(entries))
    table.notes.push_back("Warning: " + warning);
  return table;
}

namespace {

struct Span {
  double least = std::numeric_limits<double>::infinity();
  double most = -least;

  void take(double value) {
    least = std::min(least, value);
    most = std::max(most, value);
  }
  bool is_one() const { return text() == "1"; }
  std::string text() const {
    const std::string one = fmt::format("{:.3g}", least);
    const std::string other = fmt::format("{:.3g}", most);
    return one == other ? one : one + " to " + other;
  }
};

}  // namespace

std::vector<std::string> scaling_lines(const std::vector<PendulumEntry>& entries) {
  struct Scaling {
    Span amplitude, duration, largest_gn;
  };
  std::map<std::string, Scaling> of_pulses;
  for (const PendulumEntry& entry : entries) {
    Scaling& scaling = of_pulses[entry.experiment.pulse];
    scaling.amplitude.take(entry.pulse.amplitude_factor);
    scaling.duration.take(entry.pulse.duration_factor);
    scaling.largest_gn.take(largest_deceleration_m_s2(entry.pulse) * factor_from_si("m/s^2", "gn"));
  }
  std::vector<std::string> lines;
  for (const auto& [pulse, scaling] : of_pulses) {
    if (scaling.amplitude.is_one() && scaling.duration.is_one()) continue;
    lines.push_back(fmt::format(
        "Pulse '{}', scaled to stop the arm: {}{}largest {} gn", pulse,
        scaling.amplitude.is_one() ? "" : "amplitude times " + scaling.amplitude.text() + ", ",
        scaling.duration.is_one() ? "" : "duration times " + scaling.duration.text() + ", ",
        scaling.largest_gn.text()));
  }
  return lines;
}

std::vector<std::string> pulse_warnings(const std::vector<PendulumEntry>& entries) {
  constexpr double kMisfit = 0.01;
  const double in = factor_from_si("m", "in");
  std::vector<std::string> warnings;
  for (const PendulumEntry& entry : entries) {
    const double velocity = entry.experiment.impact_velocity_m_s;
    if (!(std::abs(entry.pulse.velocity_left_m_s) > kMisfit * velocity)) continue;
    warnings.push_back(fmt::format(
        "{}: the pulse '{}' removes {:.1f} in/s of {:.1f} in/s and is not scaled: the arm retains "
        "{:.1f} in/s; pulse_scaling = \"amplitude\" or \"duration\" would stop it.",
        entry.experiment.name, entry.experiment.pulse, entry.pulse.area_m_s * in, velocity * in,
        entry.pulse.velocity_left_m_s * in));
  }
  return warnings;
}

namespace {

double share_left(const PulseSection& pulse, double frequency_Hz) {
  const auto at = [&](double f) {
    return std::abs(fourier_transform(pulse.times_s, pulse.deceleration_m_s2, f));
  };
  return at(frequency_Hz) / at(0);
}

/// Names of the structure's modes that bodies of a case use. A body whose slits open uses all.
std::set<std::string> used_modes(const std::vector<PendulumEntry>& entries,
                                 const fe_modal::ModalBody& body) {
  const std::vector<std::string> all = names_of(body.modes);
  std::set<std::string> used;
  for (const PendulumEntry& entry : entries)
    for (const auto& [ignored, use] : entry.experiment.model.of_structure) {
      const bool takes_all = !use.modes || !body.slits.empty();
      const auto names = takes_all ? all : fe_modal::selected_names(body, *use.modes);
      used.insert(names.begin(), names.end());
    }
  return used;
}

}  // namespace

ResultTable spectrum_table(const Study& study, const std::vector<PendulumEntry>& entries,
                           const fe_modal::ModalBody& body) {
  const std::vector<const PulseSection*> pulses = pulses_in_use(study);
  ResultTable table;
  table.name = "pulse spectrum";
  table.title = "Normalised pulse spectrum at the frequencies of the modes";
  table.columns = {{"motion", ""}, {"frequency", "Hz"}, {"used", ""}};
  for (const PulseSection* const pulse : pulses) table.columns.push_back({pulse->name, "%"});
  const auto add = [&](const std::string& name, double frequency_Hz, bool is_used) {
    std::vector<std::string> row = {name, fmt::format("{:.2f}", frequency_Hz),
                                    is_used ? "yes" : "no"};
    for (const PulseSection* const pulse : pulses)
      row.push_back(fmt::format("{:.1f}", 100 * share_left(*pulse, frequency_Hz)));
    table.rows.push_back(std::move(row));
  };
  std::set<std::pair<CaseSection::Direction, double>> seen;
  for (const PendulumEntry& entry : entries) {
    const CaseSection& experiment = entry.experiment;
    if (!experiment.variant_of.empty() ||
        !seen.insert({experiment.direction, experiment.oblique_angle_rad}).second)
      continue;
    add("neck and head, " + experiment.name, entry.hanging.frequency_Hz, true);
  }
  const std::set<std::string> used = used_modes(entries, body);
  for (Eigen::Index k = 0; k < body.mode_count(); ++k) {
    const std::string& name = body.modes[static_cast<std::size_t>(k)].name;
    add("neck alone, " + name, body.frequencies_Hz[k], used.contains(name));
  }
  table.notes = {
      "The paper chose the first four bending modes by the frequencies in its deceleration "
      "records. Pulses as given in the study; a scaled amplitude does not change these values, a "
      "duration scaled by d divides their frequencies by d.",
      "A mode that the pulse does not excite still deforms by its static compliance; the "
      "frequencies of the neck decrease with the head attached."};
  return table;
}

std::vector<multibody::Channel> spectrum_curves(const Study& study,
                                                const Eigen::VectorXd& frequencies_Hz) {
  std::vector<multibody::Channel> channels;
  for (const PulseSection* const pulse : pulses_in_use(study))
    channels.push_back(
        {pulse->name,
         "%",
         {pulse->name},
         frequencies_Hz.unaryExpr([&](double f) { return 100 * share_left(*pulse, f); })
             .transpose(),
         ""});
  return channels;
}

}  // namespace flexneck::pipeline
