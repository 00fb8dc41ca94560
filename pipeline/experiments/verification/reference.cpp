// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/experiments/verification/reference.h"

#include "pipeline/language/document/study_document.h"
#include "pipeline/language/study/origins.h"

namespace flexneck::pipeline {

namespace {

constexpr Key kKeys[] = {
    Key::number("tolerance_percent", kRequired,
                "Tolerance of the frequencies of bending and torsion modes, in per cent"),
    Key::quantities("bending", "Hz", kRequired, "Frequencies of the bending modes, ascending"),
    Key::quantities("torsion", "Hz", kRequired, "Frequencies of the torsion modes, ascending"),
    Key::texts("mode_order", kRequired, "Kinds of the modes, by ascending frequency"),
    Key::quantity("weight", "kg", kRequired, "Mass of the neck"),
    Key::quantity("system_frequency", "Hz", kRequired,
                  "First frequency of the neck with the head attached"),
    Key::number("frequency_ratio", kRequired,
                "Ratio of the first frequency of the neck to the system frequency"),
    Key::number("effective_damping", kRequired,
                "Damping ratio of the first mode of the neck with the head attached"),
};

}  // namespace

std::span<const Key> reference_keys() { return kKeys; }

Reference read_reference(const std::filesystem::path& path) {
  const StudyDocument document(path, {}, kKeys);
  const StudyTable table = document.root();
  Reference reference;
  reference.tolerance_percent = table.number("tolerance_percent");
  reference.bending_Hz = table.quantities("bending");
  reference.torsion_Hz = table.quantities("torsion");
  reference.mode_order = table.texts("mode_order");
  reference.weight_kg = table.quantity("weight");
  reference.system_frequency_Hz = table.quantity("system_frequency");
  reference.frequency_ratio = table.number("frequency_ratio");
  reference.effective_damping = table.number("effective_damping");
  table.finish();
  reference.origins = origins_of(document.parameters(), "",
                                 {"bending", "torsion", "mode_order", "weight", "system_frequency",
                                  "frequency_ratio", "effective_damping"});
  return reference;
}

}  // namespace flexneck::pipeline
