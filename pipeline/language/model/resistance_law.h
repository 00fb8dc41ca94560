// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <string>
#include <vector>

#include "geometry/foundation/provenance.h"
#include "multibody/forces/resistance.h"
#include "pipeline/language/document/study_document.h"
#include "pipeline/language/model/csv_table.h"

namespace flexneck::pipeline {

/// SI units of a resistance: lengths and forces, or angles and moments.
struct ResistanceUnits {
  std::string deflection, load;
  std::string over(const std::string& power) const { return load + "/" + deflection + power; }
};

inline const ResistanceUnits kLinearUnits = {"m", "N"};
inline const ResistanceUnits kAngularUnits = {"rad", "N*m"};

/// Keys of one direction, besides kCsvKeys.
inline constexpr auto kResistanceSideKeys = std::to_array<Key>({
    Key::quantity("stiffness", "N/m | N*m/rad", "0", "Load per deflection"),
    Key::quantity("quadratic", "N/m^2 | N*m/rad^2", "0", "Load per square of the deflection"),
    Key::quantity("cubic", "N/m^3 | N*m/rad^3", "0", "Load per cube of the deflection"),
    Key::quantity("locks_at", "m | rad", kNone,
                  "Instead of quadratic and cubic: deflection L at which the joint locks; the load "
                  "is stiffness x / (1 - x / L)"),
    Key::quantities(
        "deflections", "m | rad", kNone,
        "Instead of stiffness, quadratic and cubic: deflections of a load curve, the first 0"),
    Key::quantities("loads", "N | N*m", kNone, "Load at each deflection, the first 0"),
    Key::quantity("stop", "m | rad", "inf", "Deflection beyond which the load of a stop is added"),
    Key::quantity("stop_stiffness", "N/m | N*m/rad", "0",
                  "Load of the stop per deflection beyond it"),
    Key::quantity("stop_quadratic", "N/m^2 | N*m/rad^2", "0",
                  "Load of the stop per square of the deflection beyond it"),
    Key::quantity("stop_cubic", "N/m^3 | N*m/rad^3", "0",
                  "Load of the stop per cube of the deflection beyond it"),
    Key::number("unloading_ratio", "1",
                "Hysteresis: ratio of the unloading load to the loading load"),
    Key::flag("may_fall", "false", "Allow a load that falls as the deflection grows"),
});

inline constexpr auto kResistanceOneSideKeys = joined(kResistanceSideKeys, kCsvKeys);

/// Keys of a resistance, besides kCsvKeys.
inline constexpr auto kResistanceKeys = joined(
    std::to_array<Key>({
        Key::table("positive", "Resistance in the positive direction only", kResistanceOneSideKeys),
        Key::table("negative", "Resistance in the negative direction only", kResistanceOneSideKeys),
        Key::quantity("damping", "N*s/m | N*m*s/rad", "0", "Viscous damping"),
        Key::quantity("friction", "N | N*m", "0", "Coulomb friction"),
        Key::quantity("full_rate", "m/s | rad/s", "0",
                      "Rate at which friction and hysteresis reach their full value; required with "
                      "either of them"),
    }),
    kResistanceSideKeys);

/// Reads one direction: stiffness with quadratic and cubic or locks_at, or deflections with loads
/// or a table, whose file is recorded by FilesRead; stop, unloading_ratio.
multibody::ResistanceSide read_resistance_side(const StudyTable& table,
                                               const ResistanceUnits& units);

/// Reads a resistance. Curves of the table itself apply to both directions, those of its sub-tables
/// positive and negative to one; damping, friction and full_rate apply to both.
multibody::Resistance read_resistance_law(const StudyTable& table, const ResistanceUnits& units);

}  // namespace flexneck::pipeline
