// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/element/moduli.h"

namespace flexneck::fe_modal {

Moduli moduli_of(const mesher::Material& material) {
  const double mu = material.youngs_modulus_Pa / (2 * (1 + material.poissons_ratio));
  const double kappa = material.youngs_modulus_Pa / (3 * (1 - 2 * material.poissons_ratio));
  return {mu, kappa, kappa - 2 * mu / 3};
}

Moduli moduli_by_poissons_ratio(const mesher::Material& material) {
  const double one = 1 + material.poissons_ratio;
  const double two = 1 - 2 * material.poissons_ratio;
  const double mu = -material.youngs_modulus_Pa / (2 * one * one);
  const double kappa = 2 * material.youngs_modulus_Pa / (3 * two * two);
  return {mu, kappa, kappa - 2 * mu / 3};
}

double projected_modulus(const ElementScheme& scheme, const Moduli& moduli) {
  if (scheme.pressures == PressureSpace::none) return 0;
  return scheme.projected == VolumetricPart::bulk ? moduli.kappa : moduli.lambda;
}

}  // namespace flexneck::fe_modal
