// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

namespace flexneck {

/// The number as files hold it: zero if it is subnormal (below 2.2e-308), where a double loses
/// digits. Some readers are slow on such numbers or refuse them.
inline double normal_number(double value) {
  return std::fpclassify(value) == FP_SUBNORMAL ? 0.0 : value;
}

}  // namespace flexneck
