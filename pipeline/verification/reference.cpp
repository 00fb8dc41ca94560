// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/verification/reference.h"

#include "pipeline/document/study_document.h"
#include "pipeline/study/origins.h"

namespace flexneck::pipeline {

Reference read_reference(const std::filesystem::path& path) {
  const StudyDocument document(path, {});
  const StudyTable table = document.root();
  Reference reference;
  reference.tolerance_percent = table.number("tolerance_percent");
  reference.bending_Hz = table.quantities("bending", "Hz", 0);
  reference.torsion_Hz = table.quantities("torsion", "Hz", 0);
  reference.mode_order = table.texts("mode_order");
  reference.weight_kg = table.quantity("weight", "kg");
  reference.system_frequency_Hz = table.quantity("system_frequency", "Hz");
  reference.frequency_ratio = table.number("frequency_ratio");
  reference.effective_damping = table.number("effective_damping");
  table.finish();
  reference.origins = origins_of(document.parameters(), "",
                                 {"bending", "torsion", "mode_order", "weight", "system_frequency",
                                  "frequency_ratio", "effective_damping"});
  return reference;
}

}  // namespace flexneck::pipeline
