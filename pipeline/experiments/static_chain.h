// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "fe_modal/body/modal_body.h"
#include "multibody/model/model.h"
#include "pipeline/language/study/study.h"

namespace flexneck::pipeline {

/// A submesh of the neck as a separate body.
struct ChainLink {
  std::string name;
  fe_modal::ModalBody body;
};

/// The static test of a case with the neck as a chain of its substructures, each joined to the
/// previous one: a body that is linear in its own frame then rotates by only a part of the neck's
/// rotation. Markers, joint and force have the names of the case's model.
/// @param links  from the base up: interfaces "base" on the first, "top" on the last, and
/// "to_<other>" where two meet
/// @throws InputError if an interface is missing, or if the case has more than the neck and forces.
multibody::Model static_chain_model(const CaseSection& experiment,
                                    const std::vector<ChainLink>& links);

}  // namespace flexneck::pipeline
