// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "fe_modal/body/modal_body.h"
#include "multibody/model/model.h"
#include "pipeline/language/study/study.h"

namespace flexneck::pipeline {

/// The model of a case with the modes of the structure, at rest; its bodies are placed so that the
/// joints close in the undeformed state. The body that a pendulum moves has no motion yet.
/// @throws InputError for modes that do not exist, a body that no joint reaches, and positions and
/// velocities that contradict each other or a start at rest.
multibody::Model case_model(const CaseSection& experiment, const fe_modal::ModalBody& structure);

/// Index of the only deformable body of a model. @throws InputError unless there is exactly one.
std::size_t deformable_body(const multibody::Model& model);

}  // namespace flexneck::pipeline
