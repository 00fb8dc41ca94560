// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <string>
#include <type_traits>

#include "geometry/foundation/byte_archive.h"
#include "multibody/equations/solver_options.h"
#include "multibody/joints/joint_kinds.h"
#include "multibody/model/model.h"

// Serialisation of a model (byte_archive.h) for an FMU, which needs no file library then. Each
// struct's fields are listed by a structured binding, which does not compile when one is added.
namespace flexneck::fe_modal {

template <class A>
void archive(A& all, StaticResponse& x) {
  auto& [compliance, mass] = x;
  all(compliance, mass);
}
template <class A>
void archive(A& all, Interface& x) {
  auto& [name, position, translation, rotation, response] = x;
  all(name, position, translation, rotation, response);
}
template <class A>
void archive(A& all, InertiaInvariants& x) {
  auto& [mass, S1, S2, J0, G0, G, N0, N, Maa] = x;
  all(mass, S1, S2, J0, G0, G, N0, N, Maa);
}
template <class A>
void archive(A& all, GeometricStiffness::OfInterface& x) {
  auto& [name, force, moment] = x;
  all(name, force, moment);
}
template <class A>
void archive(A& all, GeometricStiffness& x) {
  auto& [acceleration, angular, products, modal, interfaces] = x;
  all(acceleration, angular, products, modal, interfaces);
}
template <class A>
void archive(A& all, MeshError& x) {
  auto& [refined, mac, error] = x;
  all(refined, mac, error);
}
template <class A>
void archive(A& all, ModeRecord& x) {
  auto& [name, kind, shares, residual, mesh_error] = x;
  all(name, kind, shares, residual, mesh_error);
}
/// Data that a run does not need are left out: slits, which models have as gaps, frequencies with
/// attached bodies, and the discretisation error estimate.
template <class A>
void archive(A& all, ModalBody& x) {
  auto& [hertz, modes, boundary, prestress, of_prestress, completeness, limits, solver,
         orthogonality, nodes, shapes, interfaces, invariants, attached, stiffness, slits] = x;
  all(hertz, modes, boundary, prestress, of_prestress, completeness, solver, orthogonality, nodes,
      shapes, interfaces, invariants, stiffness);
  static_cast<void>(limits);
  static_cast<void>(attached);
  static_cast<void>(slits);
}

}  // namespace flexneck::fe_modal

namespace flexneck::multibody {

template <class A>
void archive(A& all, Pose& x) {
  auto& [position, rotation] = x;
  all(position, rotation);
}
template <class A>
void archive(A& all, HeldInput& x) {
  auto& [since, value, rate, second_rate] = x;
  all(since, value, rate, second_rate);
}
template <class A>
void archive(A& all, RigidBody& x) {
  auto& [mass, center, inertia] = x;
  all(mass, center, inertia);
}
template <class A>
void archive(A& all, SlitGaps& x) {
  auto& [stiffness, coupling] = x;
  all(stiffness, coupling);
}
template <class A>
void archive(A& all, DeformableBody& x) {
  auto& [modes, damping, offset, stiffening, modal, modal_rate, gaps] = x;
  all(modes, damping, offset, stiffening, modal, modal_rate, gaps);
}
template <class A>
void archive(A& all, SmoothMotion::Piece& x) {
  auto& [begin, end, displacement, velocity, acceleration] = x;
  all(begin, end, displacement, velocity, acceleration);
}
template <class A>
void archive(A& all, PrescribedTurn& x) {
  auto& [axis, point, rate, acceleration, motion, input] = x;
  all(axis, point, rate, acceleration, motion, input);
}
template <class A>
void archive(A& all, PrescribedBody& x) {
  auto& [direction, velocity, acceleration, motion, turn, input] = x;
  all(direction, velocity, acceleration, motion, turn, input);
}
template <class A>
void archive(A& all, Body& x) {
  auto& [name, kind, pose, velocity, angular_velocity, velocities_are_open] = x;
  all(name, kind, pose, velocity, angular_velocity, velocities_are_open);
}
template <class A>
void archive(A& all, Marker& x) {
  auto& [name, body, interface, position, rotation] = x;
  all(name, body, interface, position, rotation);
}
template <class A>
void archive(A& all, JointMotor& x) {
  auto& [name, coordinate, start, path] = x;
  all(name, coordinate, start, path);
}
template <class A>
void archive(A& all, Joint& x) {
  auto& [name, kind, marker_i, marker_j, axis, second_axis, lead, length, start_angle, motors] = x;
  std::string of_kind(kind->name);
  all(name, of_kind, marker_i, marker_j, axis, second_axis, lead, length, start_angle, motors);
  if constexpr (A::kReads) {
    const auto found = std::find_if(kJointKinds.begin(), kJointKinds.end(),
                                    [&](const JointKind* each) { return each->name == of_kind; });
    if (found == kJointKinds.end()) A::refuse();
    x.kind = *found;
  }
}

// Archive functions of force elements.
template <class A>
void archive(A& all, PointForce& x) {
  auto& [name, marker, direction, magnitude, follows, input] = x;
  all(name, marker, direction, magnitude, follows, input);
}
template <class A>
void archive(A& all, Torque& x) {
  auto& [name, marker, direction, magnitude, follows, input] = x;
  all(name, marker, direction, magnitude, follows, input);
}
template <class A>
void archive(A& all, LineForce& x) {
  auto& [name, marker_i, marker_j, magnitude, input] = x;
  all(name, marker_i, marker_j, magnitude, input);
}
template <class A>
void archive(A& all, ResistanceSide& x) {
  auto& [curve, stop, beyond_stop, unloading_ratio] = x;
  all(curve, stop, beyond_stop, unloading_ratio);
}
template <class A>
void archive(A& all, Resistance& x) {
  auto& [positive, negative, damping, friction, full_rate, tension_only] = x;
  all(positive, negative, damping, friction, full_rate, tension_only);
}
template <class A>
void archive(A& all, MarkerSpring& x) {
  auto& [name, marker_i, marker_j, free_length, resistance] = x;
  all(name, marker_i, marker_j, free_length, resistance);
}
template <class A>
void archive(A& all, JointResistance& x) {
  auto& [name, joint, coordinate, resistance] = x;
  all(name, joint, coordinate, resistance);
}
template <class A>
void archive(A& all, Bushing& x) {
  auto& [name, marker_i, marker_j, stiffness, damping] = x;
  all(name, marker_i, marker_j, stiffness, damping);
}
template <class A>
void archive(A& all, Section::Branch& x) {
  auto& [stiffness, relaxation_time] = x;
  all(stiffness, relaxation_time);
}
template <class A>
void archive(A& all, SlitFriction& x) {
  auto& [slides, coefficient, sliding_time] = x;
  all(slides, coefficient, sliding_time);
}
template <class A>
void archive(A& all, Section& x) {
  auto& [name, marker_i, marker_j, rest, stiffness, branches, bending_curve, friction] = x;
  all(name, marker_i, marker_j, rest, stiffness, branches, bending_curve, friction);
}
template <class A>
void archive(A& all, Cable& x) {
  auto& [name, marker_i, marker_j, axis, length, preload, stiffness, play] = x;
  all(name, marker_i, marker_j, axis, length, preload, stiffness, play);
}

/// @throws InputError naming a function force, which cannot be archived.
template <class A, class... Kinds>
void archive(A& all, ForceLists<Kinds...>& forces) {
  const auto each = [&]<class Kind>(std::vector<Kind>& elements) {
    if constexpr (!std::is_same_v<Kind, FunctionForce>) {
      all(elements);
    } else if (!elements.empty()) {
      throw InputError(
          title(elements.front()) +
          ": its load is a function of the calling program, which an FMU cannot contain");
    }
  };
  (each(forces.template of<Kinds>()), ...);
}
template <class A>
void archive(A& all, MeasuredAngle& x) {
  auto& [name, marker, relative_to, axis, start] = x;
  all(name, marker, relative_to, axis, start);
}
template <class A>
void archive(A& all, RunStart& x) {
  auto& [time, internal, dissipated, work] = x;
  all(time, internal, dissipated, work);
}
template <class A>
void archive(A& all, Model& x) {
  auto& [bodies, markers, joints, angles, forces, gravity, start] = x;
  all(bodies, markers, joints, angles, forces, gravity, start);
}
/// The checkpoint, a function of the program that runs the model, is left out.
template <class A>
void archive(A& all, SolverOptions& x) {
  auto& [relative, absolute, max_step, min_step, formulation, max_steps, integrator, radius,
         resolution, checkpoint] = x;
  all(relative, absolute, max_step, min_step, formulation, max_steps, integrator, radius,
      resolution);
  static_cast<void>(checkpoint);
}

}  // namespace flexneck::multibody
