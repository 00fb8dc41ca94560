// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/experiments/pendulum_tables.h"

#include <fmt/core.h>

#include "geometry/foundation/units.h"
#include "pipeline/language/study/origins.h"

namespace flexneck::pipeline {

std::string text_of(const std::optional<double>& value, const char* format, double factor) {
  return value ? fmt::format(fmt::runtime(format), *value * factor) : "-";
}

ResultTable peak_table(const Study& study, const std::vector<PendulumEntry>& entries) {
  const double deg = factor_from_si("rad", "deg");
  const double lbf_ft = factor_from_si("N*m", "lbf*ft");
  const double gn = factor_from_si("m/s^2", "gn");
  ResultTable table;
  table.name = "peaks";
  table.title = "Head/neck pendulum, peaks";
  table.columns = {{"case", ""},
                   {"head rotation", "deg"},
                   {"at", "ms"},
                   {"first zero crossing", "ms"},
                   {"neck rotation", "deg"},
                   {"at", "ms"},
                   {"head acceleration", "gn"},
                   {"at", "ms"},
                   {"base moment", "lbf*ft"},
                   {"at", "ms"},
                   {"occipital moment", "lbf*ft"},
                   {"at", "ms"}};
  for (const PendulumEntry& entry : entries) {
    const PendulumResult& result = entry.result;
    std::vector<std::string> row = {entry.experiment.name};
    const auto add = [&](const multibody::Peak& peak, double factor) {
      row.push_back(fmt::format("{:.1f}", peak.value * factor));
      row.push_back(fmt::format("{:.1f}", peak.time_s * 1e3));
    };
    add(result.head_rotation, deg);
    row.push_back(text_of(result.zero_crossing_s, "{:.1f}", 1e3));
    add(result.neck_rotation, deg);
    add(result.head_acceleration, gn);
    add(result.base_moment, lbf_ft);
    add(result.occipital_moment, lbf_ft);
    table.rows.push_back(std::move(row));
  }
  table.notes = {
      "Origin of the pulses according to the study: " + pulse_origins(study) +
          ". The paper's deceleration records are not published.",
      "Head acceleration: kinematic, along the arm's motion, CFC 1000. Moments: load of the lower "
      "body on the upper one, signs of SAE J211.",
      "First zero crossing: the head's rotation passes its hanging equilibrium after its peak."};
  return table;
}

namespace {

/// Note that lists the figures linearised at a kink; empty if there are none.
std::string kink_note(const std::vector<PendulumEntry>& entries) {
  std::string cases;
  std::string first;
  for (const PendulumEntry& entry : entries) {
    for (const auto& [mode, what] : {std::pair{&entry.hanging, " (eigenvalue)"},
                                     std::pair{&entry.weightless, " (without gravity)"}}) {
      if (mode->kink.empty()) continue;
      if (first.empty()) first = mode->kink;
      cases += (cases.empty() ? "" : ", ") + entry.experiment.name + what;
    }
  }
  if (cases.empty()) return {};
  return "Computed with the mean stiffness of both sides of a kink (" + first + "): " + cases + ".";
}

}  // namespace

ResultTable oscillation_table(const std::vector<PendulumEntry>& entries) {
  ResultTable table;
  table.name = "oscillations";
  table.title = "Head/neck pendulum, system frequency and damping";
  table.columns = {
      {"case", ""},         {"eigenvalue", "Hz"}, {"its damping", "1"}, {"without gravity", "Hz"},
      {"its damping", "1"}, {"run", "Hz"},        {"its damping", "1"}};
  for (const PendulumEntry& entry : entries) {
    table.rows.push_back({entry.experiment.name, fmt::format("{:.3f}", entry.hanging.frequency_Hz),
                          fmt::format("{:.4f}", entry.hanging.damping_ratio),
                          fmt::format("{:.3f}", entry.weightless.frequency_Hz),
                          fmt::format("{:.4f}", entry.weightless.damping_ratio),
                          text_of(entry.result.run_frequency_Hz, "{:.3f}"),
                          text_of(entry.result.run_damping_ratio, "{:.4f}")});
  }
  table.notes = {
      "The paper reports a system frequency of about 5 Hz, a seventh of the neck's first, and of "
      "an effective damping of about 0.2. The three contradict each other: a modal ratio of 0.9 at "
      "a frequency seven times higher makes about 0.13.",
      "Eigenvalue: small motions in the plane of the case about the hanging equilibrium. Run: from "
      "the zero crossings and peaks of the head rotation after the pulse."};
  if (std::string note = kink_note(entries); !note.empty()) table.notes.push_back(std::move(note));
  return table;
}

}  // namespace flexneck::pipeline
