// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "fe_modal/element/formulation.h"
#include "mesher/mesh/mesh.h"

namespace flexneck::fe_modal {

/// Moduli of an isotropic material, or their derivatives by one of its constants.
struct Moduli {
  double mu;      ///< shear modulus, Pa
  double kappa;   ///< bulk modulus, Pa
  double lambda;  ///< Lame's first parameter, Pa
};

Moduli moduli_of(const mesher::Material& material);

/// Derivatives d/dnu of the moduli at a fixed Young's modulus, Pa. The moduli are linear in the
/// latter.
Moduli moduli_by_poissons_ratio(const mesher::Material& material);

/// Modulus of the projected dilatation in a scheme: zero without a projection, kappa or lambda. It
/// is linear in the moduli, so that for their derivatives it is its own derivative.
double projected_modulus(const ElementScheme& scheme, const Moduli& moduli);

}  // namespace flexneck::fe_modal
