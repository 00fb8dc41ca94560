// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "geometry/foundation/provenance.h"
#include "multibody/forces/resistance.h"
#include "pipeline/document/study_document.h"

namespace flexneck::pipeline {

/// SI units of a resistance: of lengths and forces, or of angles and moments.
struct ResistanceUnits {
  std::string deflection, load;
  std::string over(const std::string& power) const { return load + "/" + deflection + power; }
};

inline const ResistanceUnits kLinearUnits = {"m", "N"};
inline const ResistanceUnits kAngularUnits = {"rad", "N*m"};

/// One direction: stiffness, quadratic and cubic, or deflections with loads or a table; stop,
/// unloading_ratio. A table that is read is appended to `files`.
multibody::ResistanceSide read_resistance_side(const StudyTable& table,
                                               const ResistanceUnits& units,
                                               std::vector<InputFile>& files);

/// Curves of the table itself hold for both directions, those of its sub-tables positive and
/// negative for one; damping, friction and full_rate for both.
multibody::Resistance read_resistance_law(const StudyTable& table, const ResistanceUnits& units,
                                          std::vector<InputFile>& files);

}  // namespace flexneck::pipeline
