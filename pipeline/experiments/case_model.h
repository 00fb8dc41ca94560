// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "fe_modal/body/modal_body.h"
#include "multibody/model/model.h"
#include "pipeline/study/study.h"

namespace flexneck::pipeline {

/// The model of a case: its bodies, the markers on them, the joints between them and its forces.
/// Every interface of a deformable body is a marker "body.interface". The ground or prescribed body
/// stands at the world's origin, turned by `rotation`; the others are placed so that the joints
/// close in the undeformed state. The case's rigid neck and head spring, if it has them, are in
/// place of the deformable body and of the joint that holds "head.condyles".
/// @throws InputError for a marker that does not exist or a body that no joint reaches.
multibody::Model case_model(const Study& study, const CaseSection& experiment,
                            const fe_modal::ModalBody& body, const Eigen::Quaterniond& rotation);

/// A force of the study on a model that has its marker.
multibody::PointForce point_force(const ForceSection& section, const multibody::Model& model);

/// The rigid neck of a case that has one, made equivalent to the deformable one if it is to be.
/// @throws InputError if the case has no deformable body to put it in the place of.
RigidNeckSection rigid_neck_of(const Study& study, const CaseSection& experiment,
                               const fe_modal::ModalBody& body);

}  // namespace flexneck::pipeline
