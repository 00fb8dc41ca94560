// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/experiments/relaxation_table.h"

#include <algorithm>
#include <array>
#include <complex>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/ranges.h>

#include "multibody/forces/section.h"

namespace flexneck::pipeline {
namespace {

using multibody::Section;

constexpr std::array kFrequencies_Hz = {0.5, 1., 2., 5., 10., 20., 50., 100., 200.};

/// Complex bending stiffness, slits shut, over the instantaneous stiffness.
std::complex<double> bending_ratio(const Section& section, double frequency_Hz) {
  constexpr Eigen::Index kBending = 4;
  double quick = section.stiffness(kBending, kBending);
  std::complex<double> sum = quick;
  for (const Section::Branch& branch : section.branches) {
    const double part = branch.stiffness(kBending, kBending);
    const double phase = 2 * std::numbers::pi * frequency_Hz * branch.relaxation_time_s;
    quick += part;
    sum += part * std::complex<double>(0, phase) / std::complex<double>(1, phase);
  }
  return sum / quick;
}

/// Sections with the same relaxation.
struct Alike {
  std::vector<std::string> names;
  std::vector<std::vector<std::string>> cells;  ///< one row for each frequency
  Relaxation relaxation;

  bool is_like(const Alike& other) const {
    return cells == other.cells && relaxation.fit == other.relaxation.fit &&
           relaxation.band_Hz == other.relaxation.band_Hz;
  }
};

Alike alone(const Section& section, const Relaxation& relaxation) {
  Alike found{{section.name}, {}, relaxation};
  for (const double frequency_Hz : kFrequencies_Hz) {
    const std::complex<double> ratio = bending_ratio(section, frequency_Hz);
    found.cells.push_back({fmt::format("{:g}", frequency_Hz), fmt::format("{:.3f}", ratio.real()),
                           fmt::format("{:.3f}", ratio.imag() / ratio.real())});
  }
  return found;
}

void add_sections(const multibody::Model& model,
                  const std::map<std::size_t, Relaxation>& relaxations, std::vector<Alike>& all) {
  for (const auto& [index, relaxation] : relaxations) {
    const Alike found = alone(model.forces.of<Section>()[index], relaxation);
    const auto same = std::find_if(all.begin(), all.end(),
                                   [&](const Alike& each) { return each.is_like(found); });
    if (same == all.end()) {
      all.push_back(found);
    } else if (std::find(same->names.begin(), same->names.end(), found.names.front()) ==
               same->names.end()) {
      same->names.push_back(found.names.front());
    }
  }
}

std::string band_note(const Alike& sections, const std::string& names) {
  if (!sections.relaxation.band_Hz)
    return names +
           ": the study does not give the frequencies at which the branches represent the rubber.";
  return fmt::format(
      "{}: according to the study, the branches represent the rubber from {:g} to {:g} Hz; outside "
      "this range the values are those of the branches, not of the rubber.",
      names, sections.relaxation.band_Hz->first, sections.relaxation.band_Hz->second);
}

ResultTable table_of(const std::vector<Alike>& all) {
  ResultTable table;
  table.name = "relaxation";
  table.title = "Viscoelastic sections: bending stiffness versus frequency";
  table.columns = {
      {"sections", ""}, {"frequency", "Hz"}, {"storage over quick", "1"}, {"loss factor", "1"}};
  for (const Alike& sections : all) {
    const std::string names = fmt::format("{}", fmt::join(sections.names, ", "));
    for (const std::vector<std::string>& cells : sections.cells) {
      table.rows.push_back({names});
      table.rows.back().insert(table.rows.back().end(), cells.begin(), cells.end());
    }
    table.notes.push_back(band_note(sections, names));
    const std::string& fit = sections.relaxation.fit;
    if (!fit.empty()) table.notes.push_back(names + ": Maxwell branches, " + fit + ".");
  }
  table.notes.emplace_back(
      "Bending about y, with closed slits. Quick: stiffness for motions faster than all branches.");
  return table;
}

}  // namespace

ResultTable relaxation_table(const Study& study) {
  std::vector<Alike> all;
  for (const CaseSection& experiment : study.cases)
    if (experiment.kind == CaseSection::Kind::pendulum)
      add_sections(experiment.model.model, experiment.model.relaxations, all);
  return table_of(all);
}

ResultTable relaxation_table(const multibody::Model& model,
                             const std::map<std::size_t, Relaxation>& relaxations) {
  std::vector<Alike> all;
  add_sections(model, relaxations, all);
  return table_of(all);
}

}  // namespace flexneck::pipeline
