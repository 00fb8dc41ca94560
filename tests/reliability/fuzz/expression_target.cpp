// SPDX-License-Identifier: GPL-3.0-or-later
// Target: functions of time.
#include <cmath>

#include "pipeline/language/model/expression.h"
#include "tests/reliability/fuzz/input_folder.h"

using namespace flexneck;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return fuzz::try_reader([&] {
    const pipeline::Expression expression(fuzz::text_of(data, size));
    for (const double time_s : {0.0, 0.1, -1.0, 1e300}) {
      const double once = expression(time_s);
      const double again = expression(time_s);
      fuzz::require(once == again || (std::isnan(once) && std::isnan(again)),
                    "a function has one value");
    }
  });
}
