// SPDX-License-Identifier: GPL-3.0-or-later
// Target: curves to be rated. The first line may name the column after a #.
#include <cmath>

#include "pipeline/laboratory/curve_file.h"
#include "tests/reliability/fuzz/input_folder.h"

using namespace flexneck;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::InputFolder folder;
  const std::string text = fuzz::text_of(data, size);
  const std::string first = text.substr(0, text.find('\n'));
  const std::string column = first.starts_with('#') ? first.substr(1) : "";
  return fuzz::try_reader([&] {
    const pipeline::Curve curve = pipeline::read_curve(folder.with("curve.csv", text), column);
    fuzz::require(curve.time_s.size() > 1 && curve.time_s.size() == curve.values.size(),
                  "times and values have one length");
    fuzz::require(curve.time_s.allFinite() && curve.values.allFinite(), "a curve is finite");
    for (Eigen::Index k = 1; k < curve.time_s.size(); ++k)
      fuzz::require(curve.time_s[k] > curve.time_s[k - 1], "times increase strictly");
    if (!curve.unit.empty()) static_cast<void>(pipeline::in_unit(curve, "deg"));
  });
}
