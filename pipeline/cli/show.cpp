// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>

#include <fmt/core.h>

#include "geometry/foundation/error.h"
#include "geometry/foundation/units.h"
#include "geometry/neck/neck_drawing.h"
#include "geometry/neck/neck_measures.h"
#include "geometry/plausibility.h"
#include "pipeline/cli/commands.h"
#include "pipeline/process/text_table.h"

namespace flexneck::pipeline {

namespace {

using Rows = std::vector<std::vector<std::string>>;

/// Value and origin of a key in the study.
std::array<std::string, 2> value_and_origin(const Study& study, const std::string& key) {
  const auto found =
      std::find_if(study.parameters.begin(), study.parameters.end(),
                   [&](const Parameter& parameter) { return parameter.key == "geometry." + key; });
  if (found == study.parameters.end()) return {"none", "default"};
  return {found->value, std::string(name_of(found->origin))};
}

std::string dimension_table(const Study& study) {
  Rows rows = {{"dimension", "value", "origin", "meaning"}};
  const auto add = [&](const std::string& key, const std::string& meaning) {
    const auto [value, origin] = value_and_origin(study, key);
    rows.push_back({key, value, origin, meaning});
  };
  for (const geometry::NeckDimension& dimension : geometry::neck_dimensions()) {
    add(dimension.name, dimension.meaning);
  }
  add("slits", "none, closed or open: at mid-height, front half");
  if (study.neck()->slits.depth) {
    add("slit_parts", "rubber sections with slits");
    add("slit_depth", "fraction of the rubber between rim and hole that is cut");
  }
  return text_table(rows, {0, 1, 2, 3});
}

std::string derived_table(const NeckSection& neck, const geometry::NeckMeasures& measures) {
  const double in = factor_from_si("m", "in");
  const double lb = factor_from_si("kg", "lb");
  const double lb_in2 = factor_from_si("kg*m^2", "lb*in^2");
  Rows rows = {{"derived", "customary", "SI"}};
  const auto add = [&](const std::string& what, double si, double factor, const char* unit,
                       const char* si_unit) {
    rows.push_back(
        {what, fmt::format("{:.4g} {}", si * factor, unit), fmt::format("{:.6g} {}", si, si_unit)});
  };
  add("height of each rubber section", geometry::rubber_height(neck.dimensions), in, "in", "m");
  for (const geometry::PartMeasure& part : measures.parts) {
    add("mass of " + part.part, part.mass_kg, lb, "lb", "kg");
  }
  add("mass", measures.mass_kg, lb, "lb", "kg");
  add("centre of gravity, x forward", measures.centre_m[0], in, "in", "m");
  add("centre of gravity, z above the base", measures.centre_m[2], in, "in", "m");
  const std::array<const char*, 3> axes = {"x", "y", "z"};
  for (std::size_t d = 0; d < 3; ++d) {
    add(std::string("inertia about the c.g., ") + axes[d], measures.inertia_kg_m2[d], lb_in2,
        "lb*in^2", "kg*m^2");
  }
  add("product of inertia, int x z dm", measures.product_xz_kg_m2, lb_in2, "lb*in^2", "kg*m^2");
  return text_table(rows);
}

std::string division_line(const StructureSection& structure) {
  const geometry::NeckDivisions& d = structure.neck->divisions;
  const mesher::ElementKind element =
      *std::get<mesher::ScriptMeshOptions>(structure.source).element;
  std::string line = fmt::format(
      "Mesh of {}: {} a quadrant, {} + {} rings, {} a rubber section, {} a plate, {} an end plate",
      name_of(element), d.quadrant, d.inner_ring, d.outer_ring, d.rubber_layers, d.plate_layers,
      d.end_plate_layers);
  if (d.refine > 0) line += fmt::format("; every element cut in {0} x {0} x {0}", d.refine + 1);
  if (element != mesher::ElementKind::tet10) {
    line += fmt::format(": {:.0f} elements", geometry::hexahedra(d));
  }
  return line;
}

}  // namespace

bool show_command(const CommandInput& input) {
  const NeckSection* const neck = input.study.neck();
  if (neck == nullptr) {
    throw InputError(input.study.file.string() +
                     ": --dry-run describes the built-in neck, which [geometry] does not define");
  }
  const geometry::NeckMeasures measures = measure_neck(*input.study.structure);
  input.console.result(dimension_table(input.study) + "\n\n" + derived_table(*neck, measures) +
                       "\n\n" + geometry::drawn_section(neck->dimensions, neck->slits) + "\n\n" +
                       division_line(*input.study.structure));
  for (const std::string& remark : geometry::implausibilities(
           std::max(neck->dimensions.length, neck->dimensions.plate_diameter), measures.mass_kg)) {
    input.console.warning(remark);
  }
  return true;
}

}  // namespace flexneck::pipeline
