// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/language/model/resistance_law.h"

#include "geometry/foundation/error.h"
#include "pipeline/language/model/model_sections.h"

namespace flexneck::pipeline {

using multibody::LoadCurve;
using multibody::Resistance;
using multibody::ResistanceSide;

namespace {

LoadCurve polynomial(const StudyTable& table, const std::string& prefix,
                     const ResistanceUnits& units) {
  return LoadCurve::cubic(table.quantity(prefix + "stiffness", units.over("")),
                          table.quantity(prefix + "quadratic", units.over("^2")),
                          table.quantity(prefix + "cubic", units.over("^3")));
}

LoadCurve load_curve(const StudyTable& table, const ResistanceUnits& units) {
  const bool is_table = table.has("deflections") || table.has("table");
  if (!is_table && table.has("locks_at")) {
    table.refuse_given({"quadratic", "cubic"}, "the curve is already given by locks_at");
    return at_key(table, "locks_at", [&] {
      return LoadCurve::locking(table.quantity("stiffness", units.over("")),
                                table.quantity("locks_at", units.deflection));
    });
  }
  if (!is_table) return polynomial(table, "", units);
  table.refuse_given({"stiffness", "quadratic", "cubic", "locks_at"},
                     "the curve is already given by a table");
  TableColumns columns =
      read_columns(table, {"deflections", units.deflection, "loads", units.load});
  try {
    return LoadCurve::table(std::move(columns.x), std::move(columns.y));
  } catch (const InputError& error) {
    table.refuse(table.has("table") ? "table" : "deflections", error.what());
  }
}

void refuse_if_it_falls(const StudyTable& table, const ResistanceSide& side) {
  if (table.flag("may_fall")) return;
  const bool is_table = table.has("deflections") || table.has("table");
  for (const auto& [curve, key] : {std::pair{&side.curve, is_table ? "loads" : "stiffness"},
                                   std::pair{&side.beyond_stop, "stop_stiffness"}})
    if (curve->falls())
      table.refuse(key,
                   "the load falls as the deflection grows; expected a curve that never does, or "
                   "may_fall = true");
}

}  // namespace

ResistanceSide read_resistance_side(const StudyTable& table, const ResistanceUnits& units) {
  ResistanceSide side;
  side.curve = load_curve(table, units);
  side.stop = table.quantity("stop", units.deflection);
  if (!table.has("stop"))
    table.refuse_given({"stop_stiffness", "stop_quadratic", "stop_cubic"},
                       "has no effect without 'stop', beyond which it acts");
  side.beyond_stop = polynomial(table, "stop_", units);
  side.unloading_ratio = table.number("unloading_ratio");
  refuse_if_it_falls(table, side);
  return side;
}

Resistance read_resistance_law(const StudyTable& table, const ResistanceUnits& units) {
  Resistance resistance;
  resistance.positive = resistance.negative = read_resistance_side(table, units);
  const auto side_of = [&](const char* key, ResistanceSide& side) {
    if (!table.has(key)) return;
    const StudyTable own = table.table(key);
    side = read_resistance_side(own, units);
    own.finish();
  };
  if (table.has("positive") && table.has("negative"))
    table.refuse_given(
        {"stiffness", "quadratic", "cubic", "locks_at", "deflections", "loads", "table", "column",
         "stop", "stop_stiffness", "stop_quadratic", "stop_cubic", "unloading_ratio", "may_fall"},
        "has no effect beside [positive] and [negative], which define both directions");
  side_of("positive", resistance.positive);
  side_of("negative", resistance.negative);
  resistance.damping = table.quantity("damping", units.load + "*s/" + units.deflection);
  resistance.friction = table.quantity("friction", units.load);
  resistance.full_rate = table.quantity("full_rate", units.deflection + "/s");
  return resistance;
}

}  // namespace flexneck::pipeline
