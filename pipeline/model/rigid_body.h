// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "multibody/model/model.h"
#include "pipeline/document/study_document.h"

namespace flexneck::pipeline {

/// Mass, centre and inertia of a rigid body: the keys mass, center, inertia.
multibody::RigidBody read_rigid(const StudyTable& body);

}  // namespace flexneck::pipeline
