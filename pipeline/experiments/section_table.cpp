// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/experiments/section_table.h"

#include <algorithm>
#include <string>
#include <vector>

#include <fmt/core.h>

#include "geometry/foundation/units.h"
#include "multibody/forces/section.h"

namespace flexneck::pipeline {
namespace {

using multibody::Section;

constexpr Eigen::Index kBending = 4;

/// Instantaneous bending stiffness, slits shut, N m/rad.
double bending_stiffness(const Section& section) {
  double sum = section.stiffness(kBending, kBending);
  for (const Section::Branch& branch : section.branches)
    sum += branch.stiffness(kBending, kBending);
  return sum;
}

std::string law_of(const Section& section) {
  const multibody::LoadCurve& curve = section.bending_curve;
  if (curve.is_none()) return "constant";
  const auto secant = [&](double angle) {
    return curve.value(angle) / (angle * curve.first_slope());
  };
  const double last = curve.last_row();
  return fmt::format("curve to {:.1f} deg, there {:.3f} of the first slope",
                     last * factor_from_si("rad", "deg"), secant(last));
}

std::string slits_of(const Section& section) {
  if (section.gap_count() == 0) return "none open and close";
  const std::string openings = fmt::format("{} openings", section.gap_count());
  if (!section.has_friction()) return openings + ", no friction";
  return fmt::format("{}, friction {:g}", openings, section.friction.coefficient);
}

}  // namespace

ResultTable section_table(const Study& study) {
  ResultTable table;
  table.name = "sections";
  table.title = "Sections: bending stiffness and slits";
  table.columns = {
      {"section", ""}, {"bending stiffness", "N*m/rad"}, {"over the angle", ""}, {"slits", ""}};
  bool constant = false;
  for (const CaseSection& experiment : study.cases) {
    if (experiment.kind != CaseSection::Kind::pendulum) continue;
    for (const Section& section : experiment.model.model.forces.of<Section>()) {
      std::vector<std::string> row = {section.name,
                                      fmt::format("{:.1f}", bending_stiffness(section)),
                                      law_of(section), slits_of(section)};
      constant = constant || section.bending_curve.is_none();
      if (std::find(table.rows.begin(), table.rows.end(), row) == table.rows.end())
        table.rows.push_back(std::move(row));
    }
  }
  table.notes.emplace_back("Stiffness for fast motions and with closed slits.");
  if (constant)
    table.notes.emplace_back(
        "A constant stiffness is that of small strains; rubber softens as it is bent, which "
        "bending_angles and bending_moments of a section can describe.");
  return table;
}

}  // namespace flexneck::pipeline
