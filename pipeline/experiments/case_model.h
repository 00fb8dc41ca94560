// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "fe_modal/body/modal_body.h"
#include "multibody/model.h"
#include "pipeline/study/study.h"

namespace flexneck::pipeline {

/// The model of a case: its bodies, the markers on them, the joints between them and its forces.
/// Every interface of a deformable body is a marker "body.interface". The ground or driven body
/// stands at the world's origin, turned by `rotation`; the others are placed so that the joints
/// close in the undeformed state.
/// @throws InputError for a marker that does not exist or a body that no joint reaches.
multibody::Model case_model(const Study& study, const CaseSection& experiment,
                            const fe_modal::ModalBody& body, const Eigen::Quaterniond& rotation);

}  // namespace flexneck::pipeline
