// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "fe_modal/body/modal_body.h"
#include "fe_modal/element/formulation.h"
#include "mesher/mesh/mesh.h"

namespace flexneck::fe_modal {

/// How far rounding has moved the lowest frequency that is not zero, relatively. Entries of the
/// stiffness are of the size of the bulk modulus times the element's; rounded, they no longer let a
/// body translate without force. What holds it then is lost below some 1e-16 of them: the more, the
/// nearer Poisson's ratio is to 1/2, and the more slender the body. The strain energy of the mode
/// summed from strains, element by element, and what a prestress and springs add to it, have no
/// such loss: by Rayleigh's quotient its difference from the eigenvalue is the error. Zero if there
/// is no elastic mode, and where springs are at reference points, whose motions a ModalBody does
/// not have.
double rounding_error(const mesher::Mesh& mesh, const FormulationChoice& formulation,
                      const ModalBody& body);

/// Property of the body by which rounding spoils its lowest frequencies, and what to change.
std::string cause_of_rounding(const mesher::Mesh& mesh);

}  // namespace flexneck::fe_modal
