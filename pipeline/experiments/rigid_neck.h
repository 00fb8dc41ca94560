// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "multibody/model/model.h"
#include "pipeline/language/study/study.h"

namespace flexneck::pipeline {

/// A rigid link between two pivots with axes normal to the plane of bending.
struct RigidNeck {
  struct Pivot {
    double height_m = 0;  ///< height above the base, on the neck's axis
    multibody::Resistance resistance;
  };
  multibody::RigidBody rigid;  ///< in the neck's frame
  Pivot lower, upper;
};

/// The rigid neck with the deformable neck's static response to a load at its top in the plane of
/// the case. With c_uF, c_uM and c_tM the compliances of the top's displacement to force and moment
/// and of its rotation to moment, a link of length l on springs k1 and k2 has
///   c_uF = l^2 / k1,  c_uM = l / k1,  c_tM = 1 / k1 + 1 / k2,
/// so the lower pivot lies l = c_uF / c_uM below the top, which is 2 L / 3 for a uniform beam of
/// length L. Mass and inertia are the deformable neck's; the ratio of damper to spring is that of
/// its first mode in the plane, 2 zeta / omega.
/// @param neck  with the modes that the case uses, and the interface "top"
/// @throws InputError if no such link exists: no mode in the plane, or a pivot outside the neck.
RigidNeck equivalent_neck(const multibody::DeformableBody& neck, CaseSection::Direction direction);

/// Replaces a model's deformable body, which has the interfaces "base" and "top", by a rigid neck:
/// its joints there become revolute joints about the bending axis, with springs and dampers.
/// @param index  index of that body
void put_rigid_neck(const RigidNeck& neck, CaseSection::Direction direction, std::size_t index,
                    multibody::Model& model);

/// Returns whether a case has a rigid neck in place of a deformable body.
bool has_rigid_neck(const CaseSection& experiment);

/// The rigid link on two revolute joints with springs between a model's prescribed body and its
/// head; none if the model has no such link.
std::optional<RigidNeck> rigid_neck_in(const multibody::Model& model);

}  // namespace flexneck::pipeline
