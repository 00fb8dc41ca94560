// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <optional>

#include "fe_modal/system/loads.h"
#include "pipeline/language/document/table_values.h"
#include "pipeline/language/study/sections.h"

namespace flexneck::pipeline {

namespace {

using Eigen::Vector3d;

/// Name of a kind of load and the function that reads it.
struct LoadKind {
  std::string_view name;
  decltype(fe_modal::Load::kind) (*read)(const StudyTable& load);
};

Vector3d vector_or_zero(const StudyTable& load, const std::string& key) {
  return load.has(key) ? quantity_vector(load, key) : Vector3d::Zero().eval();
}

std::optional<Vector3d> position(const StudyTable& load) {
  if (!load.has("position")) return std::nullopt;
  return quantity_vector(load, "position");
}

/// Name of the set that a load acts on; the load's name if the key is absent.
std::string set_of(const StudyTable& load) { return load.text_or("set", load.text("name")); }

void require_one_of(const StudyTable& load, const std::string& one, const std::string& other) {
  if (!load.has(one) && !load.has(other))
    load.refuse(one, "expected this key or " + other + ", found neither");
}

constexpr std::array<LoadKind, 5> kLoadKinds = {{
    {"gravity",
     [](const StudyTable& load) -> decltype(fe_modal::Load::kind) {
       return fe_modal::GravityLoad{quantity_vector(load, "acceleration")};
     }},
    {"face",
     [](const StudyTable& load) -> decltype(fe_modal::Load::kind) {
       require_one_of(load, "force", "moment");
       if (!load.has("force"))
         load.refuse_given({"position"},
                           "has no effect without force, whose point of action it is");
       return fe_modal::FaceLoad{set_of(load), vector_or_zero(load, "force"),
                                 vector_or_zero(load, "moment"), position(load)};
     }},
    {"pressure",
     [](const StudyTable& load) -> decltype(fe_modal::Load::kind) {
       return fe_modal::PressureLoad{set_of(load), load.quantity("pressure")};
     }},
    {"node",
     [](const StudyTable& load) -> decltype(fe_modal::Load::kind) {
       const std::optional<Vector3d> at = position(load);
       if (at && load.has("set")) load.refuse("set", "expected set or position, found both");
       return fe_modal::NodeLoad{at ? std::string() : set_of(load), at,
                                 quantity_vector(load, "force")};
     }},
    {"support",
     [](const StudyTable& load) -> decltype(fe_modal::Load::kind) {
       require_one_of(load, "translation", "rotation");
       if (!load.has("rotation"))
         load.refuse_given({"position"}, "has no effect without rotation, on whose axis it lies");
       return fe_modal::SupportLoad{set_of(load), vector_or_zero(load, "translation"),
                                    vector_or_zero(load, "rotation"),
                                    vector_or_zero(load, "position")};
     }},
}};

std::vector<std::string> load_kinds() {
  std::vector<std::string> names;
  for (const LoadKind& kind : kLoadKinds) names.emplace_back(kind.name);
  return names;
}

constexpr Key kLoadKeys[] = {
    Key::text("name", kRequired, "Name of the load"),
    Key::text("kind", kRequired,
              "gravity: acts on all mass; face: force and moment on a face set; pressure: on a "
              "face set; node: a force on each node of a set, or on the node at position; support: "
              "displacement of fixed nodes",
              {.choices = load_kinds}),
    Key::text("set", kNone,
              "Face set (kinds face and pressure) or node set (kinds node and support) (default: "
              "the set with the load's name)"),
    Key::quantities(
        "acceleration", "m/s^2", kNone,
        "Acceleration of gravity; for supports that accelerate, reduced by their acceleration",
        {.size = 3}),
    Key::quantities("force", "N", kNone, "Force: resultant on a face set, or force on each node",
                    {.size = 3}),
    Key::quantities("moment", "N*m", kNone, "Moment on a face set", {.size = 3}),
    Key::quantities(
        "position", "m", kNone,
        "Kind face: point where the force acts (default: the centroid); kind node: position of the "
        "node; kind support: a point on the axis of rotation (default: the origin)",
        {.size = 3}),
    Key::quantity("pressure", "Pa", kNone, "Pressure, positive if it pushes on the surface"),
    Key::quantities("translation", "m", kNone, "Translation of the support", {.size = 3}),
    Key::quantities("rotation", "rad", kNone, "Small rotation of the support", {.size = 3}),
};

}  // namespace

std::span<const Key> load_keys() { return kLoadKeys; }

fe_modal::Load read_load(const StudyTable& table) {
  fe_modal::Load load{table.text("name"), kLoadKinds.at(table.choice("kind")).read(table)};
  table.finish();
  return load;
}

}  // namespace flexneck::pipeline
