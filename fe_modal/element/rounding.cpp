// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/element/rounding.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "fe_modal/element/element_fields.h"
#include "geometry/foundation/output_file.h"

namespace flexneck::fe_modal {
namespace {

/// Work of the stresses int sigma : grad u, twice the strain energy, J.
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

/// Twice the energy of springs between nodes and to ground, J; nothing if some are at reference
/// points, whose motions a ModalBody does not have.
std::optional<double> spring_work(const mesher::Mesh& mesh, const Eigen::Matrix3Xd& mode) {
  double work = 0;
  for (const mesher::Spring& spring : mesh.connections.springs) {
    double elongation = 0;
    for (const mesher::Term& term : spring.terms) {
      if (term.site >= mode.cols()) return std::nullopt;
      elongation += Eigen::Vector3d(term.coefficients.data()).dot(mode.col(term.site));
    }
    work += spring.stiffness * elongation * elongation;
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
  const Eigen::Matrix3Xd& shape = body.shapes[static_cast<std::size_t>(mode)];
  const std::optional<double> springs = spring_work(mesh, shape);
  if (!springs) return 0;
  double work = *springs;
  for_each_element(mesh, formulation, {&shape}, [&](const ElementState& state) {
    work += stress_work(state.fields, state.shear_modulus_Pa);
  });
  if (body.prestress_stiffness.size() > 0) work += body.prestress_stiffness[mode];
  const double omega = 2 * std::numbers::pi * *elastic;
  const double exact = std::sqrt(work / body.invariants.Maa(mode, mode));
  return std::abs(omega - exact) / exact;
}

std::string cause_of_rounding(const mesher::Mesh& mesh) {
  // Entries of K contain the bulk modulus, which at a ratio of 0.45 is ten times the shear modulus.
  constexpr double kNearlyIncompressible = 0.45;
  constexpr int kDigits = 15;
  const auto nearest = std::max_element(mesh.materials.begin(), mesh.materials.end(),
                                        [](const mesher::Material& a, const mesher::Material& b) {
                                          return a.poissons_ratio < b.poissons_ratio;
                                        });
  if (nearest->poissons_ratio > kNearlyIncompressible)
    return "Poisson's ratio of '" + nearest->name + "' is " +
           rounded_text(nearest->poissons_ratio, kDigits) +
           ", too close to 1/2 for such a slender body; each digit 9 fewer reduces the error by a "
           "factor of ten";
  return "the body is so slender, or so weakly supported, that its softest motion has hardly any "
         "strain energy; model a shorter or thicker body, add supports, or use beam or plate "
         "theory";
}

}  // namespace flexneck::fe_modal
