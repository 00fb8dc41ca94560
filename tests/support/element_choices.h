// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include "fe_modal/element/formulation.h"
#include "geometry/foundation/error.h"
#include "mesher/mesh/mesh.h"

/// Element kinds and formulations that tests and benchmarks of elements loop over.
namespace flexneck::fe_modal {

inline const mesher::Material kSteel{"steel", 2.1e11, 0.3, 7850};
inline const mesher::Material kRubber{"rubber", 8.3e6, 0.49, 950};

inline constexpr std::array kFormulations = {Formulation::mixed_pressure, Formulation::displacement,
                                             Formulation::reduced};
inline constexpr std::array kFull = {Formulation::mixed_pressure, Formulation::displacement};
inline constexpr std::array kVolumes = {
    mesher::ElementKind::hex8,      mesher::ElementKind::hex20,    mesher::ElementKind::hex27,
    mesher::ElementKind::prism6,    mesher::ElementKind::prism15,  mesher::ElementKind::prism18,
    mesher::ElementKind::tet4,      mesher::ElementKind::tet10,    mesher::ElementKind::pyramid5,
    mesher::ElementKind::pyramid13, mesher::ElementKind::pyramid14};

/// Returns whether the kind has an element of this formulation.
inline bool offered(mesher::ElementKind kind, Formulation formulation) {
  try {
    static_cast<void>(element_scheme(kind, formulation));
  } catch (const InputError&) {
    return false;
  }
  return true;
}

}  // namespace flexneck::fe_modal
