// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "fe_modal/reduction/reduction.h"
#include "fe_modal/reduction/slit_fields.h"
#include "fe_modal/system/modal_options.h"

namespace flexneck::fe_modal {

/// Shapes of a body with open slits, for slits that open and close.
struct SlitBasis {
  Reduction reduction;
  std::vector<SlitField> fields;
};

/// With all slits shut the lowest modes, as many as the options say, and what the static shapes of
/// the interfaces have beyond them; and for each way in which a slit parts (slit_fields()) the
/// shape of least energy whose jumps are that way's, the interfaces free. With all amplitudes zero
/// the body is the one without slits, exactly; with openings that loads pull apart it is the open
/// one as far as its jumps are sums of the fields.
/// @param model  of the open body, no slit tied
/// @param open   of that body
/// @param loads  of the interfaces
/// @throws InputError as slit_fields() does, and for rigid interfaces and directions fixed alone
SlitBasis slit_basis(const Model& model, const BodyOperators& open,
                     const std::vector<InterfaceLoads>& loads, const Progress& progress);

}  // namespace flexneck::fe_modal
