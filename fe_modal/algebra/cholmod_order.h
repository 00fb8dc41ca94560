// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace flexneck::fe_modal {

/// Which order of elimination CHOLMOD takes.
enum class CholmodOrder {
  best,      ///< AMD's, METIS's on all degrees of freedom where AMD fills much: the better one
  given,     ///< one given with the matrix, of its blocks of three, in a postorder of its tree
  exactly,   ///< the same as it is
  numbering  ///< that of the matrix itself in blocks of three, which is taken without a copy
};

}  // namespace flexneck::fe_modal
