// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "fe_modal/element/formulation.h"
#include "mesher/mesh/mesh.h"

namespace flexneck::fe_modal {

/// Moduli of an isotropic material, or their derivatives by one of its constants.
struct Moduli {
  double mu;      ///< of shear, Pa
  double kappa;   ///< of bulk, Pa
  double lambda;  ///< Lame's first, Pa
};

Moduli moduli_of(const mesher::Material& material);

/// d/dnu of the moduli at a fixed Young's modulus, Pa. By that modulus they are linear.
Moduli moduli_by_poissons_ratio(const mesher::Material& material);

/// What the scheme's projection of the dilatation acts with: zero without one, kappa or lambda. It
/// is linear in the moduli, so that of derivatives it is the derivative.
double projected_modulus(const ElementScheme& scheme, const Moduli& moduli);

}  // namespace flexneck::fe_modal
