// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "mesher/mesh/element_kind.h"
#include "mesher/mesh/mesh.h"

namespace flexneck::fe_modal {

/// Formulation of the volumetric part of an element's strain energy.
enum class Formulation {
  mixed_pressure,  ///< p projects to pressures of the element's own, condensed: does not lock
  displacement,    ///< p is the identity, full integration; locks when nu comes near 1/2
  reduced          ///< p is the identity at fewer points, by which it locks less
};

/// Name of a formulation: "mixed_pressure", "displacement", "reduced".
std::string_view name_of(Formulation formulation);
/// Formulation of a name.
/// @throws InputError if no formulation has this name.
Formulation formulation_from(std::string_view name);

/// The formulation of each material.
struct FormulationChoice {
  Formulation of_others = Formulation::mixed_pressure;  ///< for materials that are not named
  std::map<std::string, Formulation> of_material = {};  ///< by the name of the material

  Formulation of(const mesher::Material& material) const;
};

/// Warnings: a line for each material that would lock, as nearly incompressible, nu > 0.45, but not
/// mixed, and for each part with linear tetrahedra or pyramids, or with slender quadratic ones.
std::vector<std::string> locking_warnings(const mesher::Mesh& mesh,
                                          const FormulationChoice& formulation);

/// Space of pressures of the mixed formulation, one set for each element.
enum class PressureSpace {
  none,        ///< p is the identity
  constant,    ///< {1}
  along_axis,  ///< {1, zeta}: constant on the triangles of a prism
  linear       ///< {1, x, y, z} in physical coordinates: mapped ones lose an order on elements that
               ///< are no parallelepipeds (Boffi and Gastaldi, Numer. Math. 93 (2002))
};

/// Part of the strain energy on which the projection p acts.
enum class VolumetricPart {
  bulk,  ///< kappa/2 p(div u)^2 beside mu dev(eps):dev(eps)
  lame   ///< lambda/2 p(div u)^2 beside mu eps:eps: zero if nu = 0
};

/// Strength of the quadrature of the mass: exact for every kind with straight edges, and for its
/// volume with curved ones.
inline constexpr int kMassStrength = 3;

/// Properties of an element beside its shape functions, for the kernel: a row of the table.
struct ElementScheme {
  mesher::ElementKind kind;
  Formulation formulation;
  int strength;  ///< that of the quadrature of the stiffness, as in mesher::gauss_rule
  PressureSpace pressures;
  VolumetricPart projected;
};

/// Scheme of a kind of element in a formulation.
/// @throws InputError if the kind is not available in this formulation; the message lists the
/// available ones.
const ElementScheme& element_scheme(mesher::ElementKind kind, Formulation formulation);

}  // namespace flexneck::fe_modal
