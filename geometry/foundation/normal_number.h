// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

namespace flexneck {

/// The number as files hold it: zero where it is below 2.2e-308, of which a double keeps fewer
/// digits the smaller it is. Some readers are slow on such numbers or refuse them.
inline double normal_number(double value) {
  return std::fpclassify(value) == FP_SUBNORMAL ? 0.0 : value;
}

}  // namespace flexneck
