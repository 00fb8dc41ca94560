// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "fe_modal/body/modal_body.h"
#include "fe_modal/element/formulation.h"
#include "mesher/mesh/mesh.h"

namespace flexneck::fe_modal {

/// Relative error of the lowest frequency that is not zero, by rounding. Entries of the stiffness
/// are of the size of the bulk modulus times the element's; rounded, they no longer permit a rigid
/// translation of the body without force. Stiffness below some 1e-16 of the entries is lost: the
/// error grows as Poisson's ratio approaches 1/2, and with the slenderness of the body. The strain
/// energy of the mode summed from strains, element by element, together with the energies of a
/// prestress and of springs, has no such loss: by Rayleigh's quotient its difference from the
/// eigenvalue is the error. Zero if there is no elastic mode, and if springs are at reference
/// points, whose motions a ModalBody does not have.
double rounding_error(const mesher::Mesh& mesh, const FormulationChoice& formulation,
                      const ModalBody& body);

/// Names the property of the body by which rounding falsifies its lowest frequencies, and the
/// remedy.
std::string cause_of_rounding(const mesher::Mesh& mesh);

}  // namespace flexneck::fe_modal
