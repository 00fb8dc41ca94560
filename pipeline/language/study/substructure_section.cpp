// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/language/study/substructure_section.h"

#include "geometry/foundation/names.h"
#include "pipeline/language/document/table_values.h"
#include "pipeline/language/study/sections.h"

namespace flexneck::pipeline {
namespace {

constexpr Key kPieceKeys[] = {
    Key::text("name", kRequired, "Name of the substructure and of its modes file"),
    Key::texts("parts", kNone, "Parts of the mesh that form the substructure"),
    Key::quantity("up_to", "m", kNone,
                  "Instead of parts: coordinate along the normal of the plane at which the "
                  "substructure ends; the last one has none"),
};

constexpr Key kKeys[] = {
    Key::tables("piece", "Substructures, in order", kPieceKeys),
    Key::count(
        "modes", "2",
        "Number of modes of each substructure with fixed interfaces, in addition to static shapes",
        {.range = at_least(0)}),
    Key::text(
        "slits", "cracks",
        "Model of open slits: cracks without contact; openings, which open and close and do not "
        "slide while closed; or openings whose sides slide without friction, open or closed",
        {.choices = [] { return fe_modal::slit_motion_names(); }}),
    Key::numbers("normal", kNone, "Normal of the cutting planes (default: z)", {.size = 3}),
};

PieceSection read_piece(const StudyTable& table) {
  PieceSection piece;
  piece.name = table.text("name");
  if (table.has("parts")) piece.parts = table.texts("parts");
  if (table.has("up_to")) piece.up_to_m = table.quantity("up_to");
  if (!piece.parts.empty() && piece.up_to_m) {
    table.refuse("up_to", "expected parts or up_to, found both");
  }
  table.finish();
  return piece;
}

/// Checks that each submesh has parts, or that each but the last has a plane.
void check_pieces(const StudyTable& table, const SubstructuresSection& section) {
  for (std::size_t p = 0; p < section.pieces.size(); ++p) {
    const PieceSection& piece = section.pieces[p];
    const bool is_last = p + 1 == section.pieces.size();
    if (!section.by_planes && piece.parts.empty()) {
      table.refuse("piece", "expected parts for substructure '" + piece.name +
                                "', as for the ones before it");
    }
    if (section.by_planes && (is_last ? piece.up_to_m.has_value() || !piece.parts.empty()
                                      : !piece.up_to_m.has_value())) {
      table.refuse("piece", is_last
                                ? "expected neither parts nor up_to for the last substructure '" +
                                      piece.name + "', which consists of the rest"
                                : "expected up_to for substructure '" + piece.name +
                                      "', as for the ones before it");
    }
  }
}

}  // namespace

std::span<const Key> substructures_keys() { return kKeys; }

SubstructuresSection read_substructures(const StudyTable& table) {
  SubstructuresSection section;
  for (const StudyTable& piece : table.tables("piece")) {
    section.pieces.push_back(read_piece(piece));
  }
  check_names(names_of(section.pieces), "piece");
  if (section.pieces.empty())
    table.refuse_given({"modes", "slits", "normal"},
                       "has no effect without [[substructures.piece]]");
  section.modes = table.count("modes");
  section.slit_motions = static_cast<fe_modal::SlitMotions>(table.choice("slits"));
  if (table.has("normal")) section.normal = unit_vector(table, "normal");
  if (section.pieces.size() == 1) {
    table.refuse("piece", "expected at least two substructures, found one");
  }
  section.by_planes = !section.pieces.empty() && section.pieces.front().up_to_m.has_value();
  check_pieces(table, section);
  if (!section.by_planes)
    table.refuse_given({"normal"}, "has no effect on substructures that are given by parts");
  table.finish();
  return section;
}

}  // namespace flexneck::pipeline
