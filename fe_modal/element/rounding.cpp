// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/element/rounding.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fe_modal/element/element_fields.h"

namespace flexneck::fe_modal {
namespace {

/// int sigma : grad u, twice the strain energy, J.
double stress_work(const PointFields& fields, double shear_modulus_Pa) {
  double work = 0;
  for (Eigen::Index q = 0; q < fields.volumes_m3.size(); ++q) {
    double shear = 0;
    double dilatation = 0;
    for (std::size_t a = 0; a < 3; ++a) {
      dilatation += fields.gradients[4 * a](0, q);
      for (std::size_t b = 0; b < 3; ++b) {
        const double ab = fields.gradients[3 * a + b](0, q);
        shear += ab * (ab + fields.gradients[3 * b + a](0, q));
      }
    }
    work +=
        fields.volumes_m3[q] * (shear_modulus_Pa * shear + fields.volumetric_Pa(0, q) * dilatation);
  }
  return work;
}

}  // namespace

double rounding_error(const mesher::Mesh& mesh, const FormulationChoice& formulation,
                      const ModalBody& body) {
  const auto elastic = std::find_if(body.frequencies_Hz.begin(), body.frequencies_Hz.end(),
                                    [](double frequency) { return frequency > 0; });
  if (elastic == body.frequencies_Hz.end()) return 0;
  const Eigen::Index mode = elastic - body.frequencies_Hz.begin();
  double work = 0;
  for_each_element(mesh, formulation, {&body.shapes[static_cast<std::size_t>(mode)]},
                   [&](const ElementState& state) {
                     work += stress_work(state.fields, state.shear_modulus_Pa);
                   });
  if (body.prestress_stiffness.size() > 0) work += body.prestress_stiffness[mode];
  const double omega = 2 * std::numbers::pi * *elastic;
  const double exact = std::sqrt(work / body.invariants.Maa(mode, mode));
  return std::abs(omega - exact) / exact;
}

}  // namespace flexneck::fe_modal
