// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include "multibody/model/model.h"
#include "pipeline/language/document/study_document.h"

namespace flexneck::pipeline {

/// Keys of mass, centre and inertia, needed for rigid bodies only.
inline constexpr std::array<Key, 3> kRigidBodyKeys = {{
    Key::quantity("mass", "kg", kNone, "Mass of a rigid body"),
    Key::quantities("center", "m", kNone, "Centre of mass in the body's frame", {.size = 3}),
    Key::quantities(
        "inertia", "kg*m^2", kNone,
        "Inertia about the centre of mass: three principal moments, or xx, yy, zz, xy, xz, yz of "
        "the inertia tensor (off-diagonal entries: the negative products of inertia)"),
}};

/// Inertia about the centre from its six elements xx, yy, zz, xy, xz, yz of the tensor, or from the
/// first three: the products carry the tensor's sign, Ixz = -int x z dm.
Eigen::Matrix3d read_inertia(const StudyTable& table, const std::string& key);
/// Reads the keys kRigidBodyKeys.
multibody::RigidBody read_rigid(const StudyTable& body);

}  // namespace flexneck::pipeline
