// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "mesher/mesh/element_kind.h"
#include "mesher/mesh/mesh.h"

namespace flexneck::fe_modal {

/// How the volumetric part of an element's strain energy is formed.
enum class Formulation {
  mixed_pressure,  ///< p projects to pressures of the element's own, condensed: does not lock
  displacement,    ///< p is the identity, full integration; locks when nu comes near 1/2
  reduced          ///< the same at fewer points, by which it locks less
};

/// "mixed_pressure", "displacement", "reduced".
std::string_view name_of(Formulation formulation);
/// @throws InputError if no formulation has this name.
Formulation formulation_from(std::string_view name);

/// The formulation of each material.
struct FormulationChoice {
  Formulation of_others = Formulation::mixed_pressure;  ///< of materials that are not named
  std::map<std::string, Formulation> of_material = {};  ///< by name

  Formulation of(const mesher::Material& material) const;
};

/// A line for each material that would lock, nearly incompressible, nu > 0.45, but not mixed, and
/// for each part with linear tetrahedra or pyramids, or with slender quadratic ones.
std::vector<std::string> locking_warnings(const mesher::Mesh& mesh,
                                          const FormulationChoice& formulation);

/// Pressures of the mixed formulation, one set for each element.
enum class PressureSpace {
  none,        ///< p is the identity
  constant,    ///< {1}
  along_axis,  ///< {1, zeta}: constant on the triangles of a prism
  linear       ///< {1, x, y, z} in physical coordinates: mapped ones lose an order on elements that
               ///< are no parallelepipeds (Boffi and Gastaldi, Numer. Math. 93 (2002))
};

/// What of the strain energy the projection p acts on.
enum class VolumetricPart {
  bulk,  ///< kappa/2 p(div u)^2 beside mu dev(eps):dev(eps)
  lame   ///< lambda/2 p(div u)^2 beside mu eps:eps: nothing where nu = 0
};

/// Of the quadrature of the mass: exact for every kind with straight edges, and for its volume with
/// curved ones.
inline constexpr int kMassStrength = 3;

/// All that the kernel must know of an element beside its shape functions: a row of the table.
struct ElementScheme {
  mesher::ElementKind kind;
  Formulation formulation;
  int strength;  ///< of the quadrature of the stiffness, as in mesher::gauss_rule
  PressureSpace pressures;
  VolumetricPart projected;
};

/// @throws InputError if the kind is not offered in this formulation; the message lists those it
/// is.
const ElementScheme& element_scheme(mesher::ElementKind kind, Formulation formulation);

}  // namespace flexneck::fe_modal
