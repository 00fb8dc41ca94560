// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace flexneck::fe_modal {

/// Package that computes and applies the Cholesky factor of K.
enum class Solver {
  automatic,  ///< CHOLMOD in one process, MUMPS on several
  cholmod,
  mumps
};

/// Names of the packages that may be chosen, in the order of the enumeration.
inline std::vector<std::string> solver_names() { return {"automatic", "cholmod", "mumps"}; }

}  // namespace flexneck::fe_modal
