// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "multibody/model/model.h"
#include "pipeline/study/study.h"

namespace flexneck::pipeline {

/// A rigid link between two pivots that turn in the plane of bending.
struct RigidNeck {
  struct Pivot {
    double height_m = 0;  ///< above the base, on the neck's axis
    multibody::Resistance resistance;
  };
  multibody::RigidBody rigid;  ///< neck frame
  Pivot lower, upper;
};

/// The rigid neck that answers a static load at its top in the plane of the case as the deformable
/// one does. With c_uF, c_uM and c_tM the compliances of the top's displacement to force and
/// moment and of its rotation to moment, a link of length l on springs k1 and k2 has
///   c_uF = l^2 / k1,  c_uM = l / k1,  c_tM = 1 / k1 + 1 / k2,
/// so the lower pivot lies l = c_uF / c_uM below the top. For a uniform beam of length L that is
/// 2 L / 3. Mass and inertia are the deformable neck's; dampers are to springs as in its first mode
/// in the plane, 2 zeta / omega.
/// @param neck  with the modes that the case uses, and the interface "top"
/// @throws InputError if no such link exists: no mode in the plane, or a pivot outside the neck.
RigidNeck equivalent_neck(const multibody::DeformableBody& neck, CaseSection::Direction direction);

/// Puts a rigid neck in the place of a model's deformable body, which has the interfaces "base" and
/// "top": its joints there become pins about the axis of bending, with springs and dampers.
/// @param index  of that body
void put_rigid_neck(const RigidNeck& neck, CaseSection::Direction direction, std::size_t index,
                    multibody::Model& model);

/// Whether a case has no deformable body: a rigid neck in its place.
bool has_rigid_neck(const CaseSection& experiment);

/// What a model has between its prescribed body and its head if that is a rigid link on two pins
/// with springs; none otherwise.
std::optional<RigidNeck> rigid_neck_in(const multibody::Model& model);

}  // namespace flexneck::pipeline
