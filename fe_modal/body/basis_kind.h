// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace flexneck::fe_modal {

/// What a body is reduced to.
enum class BasisKind {
  normal,    ///< eigenvectors of the body, fixed or free
  residual,  ///< of a fixed body, with what the static shapes of interface loads have beyond them
  craig_bampton,  ///< modes with the interfaces fixed as well, and the static shapes
  inertia_relief  ///< eigenvectors of a free body, with what the static shapes of interface loads
                  ///< and balancing inertia forces have beyond them
};

/// "normal", "residual", "craig-bampton", "inertia-relief": in the order of the enumeration.
const std::vector<std::string>& basis_names();

/// What open slits are in a basis with static shapes.
enum class SlitMotions {
  none,                 ///< cracks without contact
  openings,             ///< two coordinates a slit, not below zero; shut sides stick
  openings_and_sliding  ///< the sides slide without friction, open or shut
};

/// "cracks", "openings", "openings-and-sliding": in the order of the enumeration.
const std::vector<std::string>& slit_motion_names();

/// Kinds of vectors in a basis, as they stand in the file.
inline constexpr std::string_view kNormalMode = "normal";          ///< an eigenvector
inline constexpr std::string_view kRigidMode = "rigid";            ///< one of frequency zero
inline constexpr std::string_view kResidualMode = "residual";      ///< residual attachment
inline constexpr std::string_view kReliefMode = "inertia relief";  ///< the same of a free body
inline constexpr std::string_view kRitzMode = "ritz";              ///< Craig-Bampton, of the lowest
inline constexpr std::string_view kConstraintMode =
    "constraint";  ///< Craig-Bampton, of the highest

/// True of vectors that only complete the static compliance: their frequencies are those of no
/// mode of the body.
bool is_correction(std::string_view kind);

}  // namespace flexneck::fe_modal
