// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace flexneck::fe_modal {

/// Which order of elimination CHOLMOD takes.
enum class CholmodOrder {
  best,      ///< AMD's, METIS's on all degrees of freedom where AMD fills much: the better one
  given,     ///< one given with the matrix, in a postorder of its tree
  exactly,   ///< one given with the matrix, as it is
  numbering  ///< that of the matrix itself, which is taken without a copy
};

}  // namespace flexneck::fe_modal
