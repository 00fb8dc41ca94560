// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/experiments/static_tables.h"

#include <cmath>

#include <fmt/core.h>

#include "geometry/foundation/units.h"
#include "multibody/numerics/time_table.h"

namespace flexneck::pipeline {

using Eigen::Index;

namespace {

double deg() { return factor_from_si("rad", "deg"); }
double lbf() { return factor_from_si("N", "lbf"); }
double in_lbf() { return factor_from_si("N*m", "in*lbf"); }

std::vector<std::string> row_of(const std::string& name, const StaticTestSignals& signals) {
  const StaticTestResult result = static_test_result(signals);
  return {name,
          fmt::format("{:.3f}", result.rotation * deg()),
          fmt::format("{:.3f}", result.deflection * factor_from_si("m", "in")),
          fmt::format("{:.1f}", result.base_moment * in_lbf()),
          fmt::format("{:.2f}", result.initial_stiffness * in_lbf() / deg()),
          fmt::format("{:.2f}", result.final_stiffness * in_lbf() / deg()),
          fmt::format("{:.1f}", 100 * signals.stretch.tail<1>()[0])};
}

multibody::TimeTable over_time(const Eigen::VectorXd& time_s, const Eigen::VectorXd& signal) {
  return {{time_s.begin(), time_s.end()},
          {signal.begin(), signal.end()},
          multibody::TimeTable::Outside::constant};
}

/// Index of the first sample whose magnitude exceeds a bound, if any.
std::optional<Index> passes(const Eigen::VectorXd& signal, double bound) {
  for (Index k = 0; k < signal.size(); ++k)
    if (std::abs(signal[k]) > bound) return k;
  return {};
}

/// Note on the load from which a linear body stretches too much, judged by its own motion.
std::string stretch_note(const StaticEntry& entry) {
  constexpr double kStretch = 0.01;
  const StaticTestSignals& signals = entry.ramp;
  const std::optional<Index> sample = passes(signals.stretch, kStretch);
  if (!sample) return {};
  return fmt::format(
      "{}: the top of the linear body moves along a straight line; from {:.0f} lbf and {:.0f} deg "
      "on, the chord of the neck is more than 1 % longer than the neck. Beyond that, the values "
      "are linear extrapolations.",
      entry.experiment.name, signals.load[*sample] * lbf(),
      std::abs(signals.rotation[*sample]) * deg());
}

}  // namespace

ResultTable static_table(const std::vector<StaticEntry>& entries, bool has_own_moduli) {
  ResultTable table;
  table.name = "static tests";
  table.title = "Static neck tester, at the end of the ramp" +
                std::string(has_own_moduli ? ", with the static moduli" : "");
  table.columns = {{"case", ""},
                   {"rotation", "deg"},
                   {"deflection", "in"},
                   {"base moment", "in*lbf"},
                   {"initial", "in*lbf/deg"},
                   {"final", "in*lbf/deg"},
                   {"spurious elongation", "%"}};
  for (const StaticEntry& entry : entries) {
    table.rows.push_back(row_of(entry.experiment.name, entry.ramp));
    if (entry.chain) table.rows.push_back(row_of(entry.experiment.name + "-chain", *entry.chain));
    if (const std::string note = stretch_note(entry); !note.empty()) table.notes.push_back(note);
  }
  table.notes.push_back(
      "Initial and final: slope of the base moment over the top's rotation in the first and the "
      "last tenth of the ramp. The published test curve is not available.");
  if (!has_own_moduli)
    table.notes.push_back(
        "The moduli are the dynamic ones of the modes, as in the paper, which finds them too stiff "
        "here; geometry.materials.<name>.static_modulus_ratio gives a material another one.");
  return table;
}

ResultTable ramp_table(const std::vector<StaticEntry>& entries) {
  ResultTable table;
  table.name = "ramp against statics";
  table.title = "Static neck tester: simulated ramp compared with static solutions";
  table.columns = {{"case", ""},
                   {"largest difference", "deg"},
                   {"of the rotation at the end", "%"},
                   {"lag", "ms"}};
  for (const StaticEntry& entry : entries) {
    const StaticTestSignals& still = entry.settled;
    const Index last = still.rotation.size() - 1;
    const multibody::TimeTable moving = over_time(entry.ramp.time_s, entry.ramp.rotation);
    double largest = 0;
    for (Index k = 0; k <= last; ++k) {
      const double difference = still.rotation[k] - moving.value(still.time_s[k]);
      if (std::abs(difference) > std::abs(largest)) largest = difference;
    }
    const double rate = still.rotation[last] / still.time_s[last];
    table.rows.push_back({entry.experiment.name, fmt::format("{:.4f}", largest * deg()),
                          fmt::format("{:.3f}", 100 * largest / still.rotation[last]),
                          fmt::format("{:.2f}", largest / rate * 1e3)});
  }
  table.notes = {
      "The difference is the effect of damping and inertia on the ramp: a body with the damping "
      "ratio zeta lags the static solution by 2 zeta / omega of its first mode."};
  return table;
}

ResultTable chain_table(const std::vector<StaticEntry>& entries) {
  constexpr std::array kShares = {0.025, 0.25, 0.5, 0.75, 1.0};
  constexpr double kApart = 0.05;
  ResultTable table;
  table.name = "linear against chain";
  table.title = "Static neck tester: one linear body compared with a chain of bodies";
  table.columns = {{"case", ""},
                   {"load", "lbf"},
                   {"rotation, linear", "deg"},
                   {"rotation, chain", "deg"},
                   {"deflection, linear", "in"},
                   {"deflection, chain", "in"},
                   {"moment, linear", "in*lbf"},
                   {"moment, chain", "in*lbf"}};
  const double in = factor_from_si("m", "in");
  for (const StaticEntry& entry : entries) {
    if (!entry.chain) continue;
    const StaticTestSignals& linear = entry.settled;
    const StaticTestSignals& chain = *entry.chain;
    for (const double share : kShares) {
      const double time_s = share * linear.time_s.tail<1>()[0];
      using Signals = StaticTestSignals;
      const auto at_load = [&](const Signals& signals, auto member, double factor, int digits) {
        const double value = over_time(signals.time_s, signals.*member).value(time_s);
        return fmt::format("{:.{}f}", factor * value, digits);
      };
      table.rows.push_back({entry.experiment.name, at_load(linear, &Signals::load, lbf(), 0),
                            at_load(linear, &Signals::rotation, deg(), 2),
                            at_load(chain, &Signals::rotation, deg(), 2),
                            at_load(linear, &Signals::deflection, in, 3),
                            at_load(chain, &Signals::deflection, in, 3),
                            at_load(linear, &Signals::base_moment, in_lbf(), 0),
                            at_load(chain, &Signals::base_moment, in_lbf(), 0)});
    }
    const Eigen::VectorXd apart =
        (linear.deflection - chain.deflection).array() / linear.deflection.array().abs().max(1e-12);
    if (const auto sample = passes(apart, kApart))
      table.notes.push_back(
          fmt::format("{}: the deflection at the top of the linear body differs by more than 5 % "
                      "from that of the chain from {:.0f} lbf and {:.0f} deg on.",
                      entry.experiment.name, linear.load[*sample] * lbf(),
                      std::abs(chain.rotation[*sample]) * deg()));
  }
  table.notes.push_back(
      "Each body of the chain is linear in its own frame; rubber that stiffens at large strains, "
      "slits that close and the cable are in neither model.");
  return table;
}

}  // namespace flexneck::pipeline
