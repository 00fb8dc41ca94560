// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "fe_modal/body/modal_body.h"
#include "multibody/model/model.h"
#include "pipeline/study/study.h"

namespace flexneck::pipeline {

/// A piece of the neck as a body of its own.
struct ChainLink {
  std::string name;
  fe_modal::ModalBody body;
};

/// The static test of a case with the neck as a chain of its substructures, each joined to the one
/// before it: a body that is linear in its own frame turns by a part of the neck's rotation only.
/// Markers, joint and force have the names that the case's model gives them.
/// @param links  from the base up: interfaces "base" on the first, "top" on the last, and
///               "to_<other>" where two meet
/// @throws InputError if an interface is missing, or if the case has more than the neck and forces.
multibody::Model static_chain_model(const CaseSection& experiment,
                                    const std::vector<ChainLink>& links);

}  // namespace flexneck::pipeline
