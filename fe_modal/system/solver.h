// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace flexneck::fe_modal {

/// How K is solved with.
enum class Solver {
  direct,    ///< by a factor
  iterative  ///< by iteration, in less memory and more time
};

}  // namespace flexneck::fe_modal
