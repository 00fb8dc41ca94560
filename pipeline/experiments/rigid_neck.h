// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "multibody/model/model.h"
#include "pipeline/study/study.h"

namespace flexneck::pipeline {

/// The rigid neck that answers a static load at its top in the plane of the case as the deformable
/// one does. With c_uF, c_uM and c_tM the compliances of the top's displacement to force and
/// moment and of its rotation to moment, a link of length l on springs k1 and k2 has
///   c_uF = l^2 / k1,  c_uM = l / k1,  c_tM = 1 / k1 + 1 / k2,
/// so the lower pivot lies l = c_uF / c_uM below the top. For a uniform beam of length L that is
/// 2 L / 3. Mass and inertia are the deformable neck's; dampers are to springs as in its first mode
/// in the plane, 2 zeta / omega.
/// @param neck  with the modes that the case uses, and the interface "top"
/// @throws InputError if no such link exists: no mode in the plane, or a pivot outside the neck.
RigidNeckSection equivalent_neck(const multibody::DeformableBody& neck,
                                 CaseSection::Direction direction);

/// Puts a rigid neck in the place of a model's deformable body, which has the interfaces "base" and
/// "top": its joints there become pins about the axis of bending, with springs and dampers.
/// @param index  of that body
void put_rigid_neck(const RigidNeckSection& neck, CaseSection::Direction direction,
                    std::size_t index, multibody::Model& model);

}  // namespace flexneck::pipeline
