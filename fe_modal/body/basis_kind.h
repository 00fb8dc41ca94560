// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace flexneck::fe_modal {

/// Kind of the basis to which a body is reduced.
enum class BasisKind {
  normal,  ///< eigenvectors of the body, fixed or free
  /// Eigenvectors of a fixed body, with the static shapes of interface loads less their modal part.
  residual,
  craig_bampton,  ///< modes with the interfaces fixed as well, and the static shapes
  /// Eigenvectors of a free body, with the static shapes of interface loads and balancing inertia
  /// forces, less their modal part.
  inertia_relief
};

/// Names of the bases, in the order of the enumeration: "normal", "residual", "craig-bampton",
/// "inertia-relief".
const std::vector<std::string>& basis_names();

/// Treatment of open slits in a basis with static shapes.
enum class SlitMotions {
  none,                 ///< cracks without contact
  openings,             ///< two coordinates per slit, not below zero; shut sides stick
  openings_and_sliding  ///< the sides slide without friction, open or shut
};

/// Names of the treatments of slits, in the order of the enumeration: "cracks", "openings",
/// "openings-and-sliding".
const std::vector<std::string>& slit_motion_names();

/// Kinds of vectors in a basis, as they stand in the file.
inline constexpr std::string_view kNormalMode = "normal";      ///< an eigenvector
inline constexpr std::string_view kRigidMode = "rigid";        ///< mode of frequency zero
inline constexpr std::string_view kResidualMode = "residual";  ///< residual attachment
/// Residual attachment of a free body.
inline constexpr std::string_view kReliefMode = "inertia relief";
inline constexpr std::string_view kRitzMode = "ritz";  ///< Craig-Bampton, of the lowest
inline constexpr std::string_view kConstraintMode =
    "constraint";  ///< Craig-Bampton, of the highest

/// True for vectors that only complete the static compliance: their frequencies are not those of
/// modes of the body.
bool is_correction(std::string_view kind);

}  // namespace flexneck::fe_modal
