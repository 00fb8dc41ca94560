// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "fe_modal/body/modal_body.h"
#include "multibody/model/model.h"
#include "pipeline/study/study.h"

namespace flexneck::pipeline {

/// The model of a case with the modes of the structure, its bodies placed so that the joints close
/// in the undeformed state, at rest. The body that a pendulum moves has no motion yet.
/// @throws InputError for modes that do not exist, a body that no joint reaches, and places and
/// velocities that contradict each other or a start at rest.
multibody::Model case_model(const CaseSection& experiment, const fe_modal::ModalBody& structure);

/// The one deformable body of a model. @throws InputError if there is none, or another.
std::size_t deformable_body(const multibody::Model& model);

}  // namespace flexneck::pipeline
