// SPDX-License-Identifier: GPL-3.0-or-later
// Target: reference figures of a verification.
#include <algorithm>
#include <cmath>

#include "pipeline/experiments/verification/reference.h"
#include "tests/reliability/fuzz/input_folder.h"

using namespace flexneck;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::InputFolder folder;
  const std::string text = fuzz::text_of(data, size);
  return fuzz::try_reader([&] {
    const pipeline::Reference reference =
        pipeline::read_reference(folder.with("reference.toml", text));
    for (const double value :
         {reference.tolerance_percent, reference.weight_kg, reference.system_frequency_Hz,
          reference.frequency_ratio, reference.effective_damping})
      fuzz::require(std::isfinite(value), "a reference is finite");
    for (const auto& list : {reference.bending_Hz, reference.torsion_Hz})
      for (const double value : list) fuzz::require(std::isfinite(value), "a frequency is finite");
  });
}
