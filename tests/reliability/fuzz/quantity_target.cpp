// SPDX-License-Identifier: GPL-3.0-or-later
// Target: numbers with their units; the first byte selects the dimension.
#include <array>
#include <cmath>

#include "geometry/foundation/units.h"
#include "tests/reliability/fuzz/input_folder.h"

using namespace flexneck;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr std::array<const char*, 8> kUnits = {"m",     "Pa", "kg/m^3",  "kg*m^2",
                                                 "rad/s", "Hz", "N*m/rad", "1"};
  if (size == 0) return 0;
  const std::string unit = kUnits[data[0] % kUnits.size()];
  const std::string text = fuzz::text_of(data + 1, size - 1);
  fuzz::try_reader(
      [&] { fuzz::require(std::isfinite(parse_quantity(text, unit)), "a quantity is finite"); });
  return fuzz::try_reader([&] {
    const double factor = factor_from_si(unit, text);
    const double back = factor_from_si(text, unit);
    fuzz::require(!std::isfinite(factor * back) || std::abs(factor * back - 1) < 1e-12,
                  "factors there and back are inverse");
  });
}
