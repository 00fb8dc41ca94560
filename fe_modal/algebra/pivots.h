// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace flexneck::fe_modal {

/// Those that a factor of a symmetric matrix may have: L L^T, or L S L^T with S of +1 and -1.
enum class Pivots { positive, of_any_sign };

/// What is said of a matrix that has no Cholesky factor.
inline constexpr const char* kNotDefinite =
    "the stiffness matrix is not positive definite: a part of the body is not fixed, or elements "
    "with reduced integration stand in a single row, or rounding hides how little the body resists "
    "in some motion, being very slender or of a Poisson's ratio near 1/2";

}  // namespace flexneck::fe_modal
