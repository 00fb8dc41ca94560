// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "mesher/mesh/element_kind.h"

namespace flexneck::mesher {

/// Node order of an element that Abaqus, CalculiX and VTK (so XDMF) share: corners as in
/// ElementKind; then the edges of the lower face in order around it, those of the upper face, and
/// those from the lower to the upper face (of a tetrahedron and a pyramid: to the apex); then the
/// faces that VTK knows, -xi, +xi, -eta, +eta, -zeta, +zeta of a hexahedron, the sides of a prism
/// in order around it; the centre. Entry k is the local node at position k.
/// Sources: Abaqus 6.14 Theory, "Solid element library"; CalculiX CrunchiX manual 2.20,
/// section 6.2; VTK 9, vtkTriQuadraticHexahedron.h and vtkBiQuadraticQuadraticWedge.h.
std::vector<std::size_t> edge_order(ElementKind kind);

}  // namespace flexneck::mesher
