// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "fe_modal/reduction/reduction.h"
#include "fe_modal/reduction/slit_fields.h"
#include "fe_modal/system/modal_options.h"
#include "fe_modal/system/model.h"

namespace flexneck::fe_modal {

/// Shapes of a body with open slits, for slits that open and close.
struct SlitBasis {
  Reduction reduction;
  std::vector<SlitField> fields;
};

/// Basis of the body with all slits shut, its lowest modes, as many as the options say, and the
/// interfaces' static shapes less the modes' part; and for each motion of a slit (slit_fields())
/// the shape of least energy with the jumps of that motion, the interfaces free. With all
/// amplitudes zero the body is exactly the one without slits; with openings under loads that pull
/// the sides apart it is the open one as far as its jumps are sums of the fields.
/// @param model  that of the open body, no slit tied
/// @param open   operators of that body
/// @param loads  those of its interfaces
/// @throws InputError as slit_fields() does, and for rigid interfaces and sets fixed in some
/// directions
SlitBasis slit_basis(const Model& model, const BodyOperators& open,
                     const std::vector<InterfaceLoads>& loads, const Progress& progress);

}  // namespace flexneck::fe_modal
