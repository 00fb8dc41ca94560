// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "mesher/mesh/element_kind.h"

namespace flexneck::mesher {

/// Where the nodes of an element stand in the order that Abaqus, CalculiX and VTK (so XDMF) share:
/// corners as ours; then the edges of the lower face round, of the upper face round, and from the
/// lower to the upper (of a tetrahedron and a pyramid: to the apex); then the faces that VTK knows
/// -xi, +xi, -eta, +eta, -zeta, +zeta of a hexahedron, the sides of a prism round; the centre.
/// Entry k is our local node that stands there at position k.
/// Sources: Abaqus 6.14 Theory, "Solid element library"; CalculiX CrunchiX manual 2.20,
/// section 6.2; VTK 9, vtkTriQuadraticHexahedron.h and vtkBiQuadraticQuadraticWedge.h.
std::vector<std::size_t> edge_order(ElementKind kind);

}  // namespace flexneck::mesher
