// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "multibody/descriptor/body_dynamics.h"
#include "multibody/descriptor/kkt_solver.h"
#include "multibody/descriptor/node_kinematics.h"
#include "multibody/equations/force_set.h"
#include "multibody/model/model.h"
#include "multibody/model/prescribed_path.h"

namespace flexneck::multibody {

/// A body with degrees of freedom, and its place in the state. Its positions are x, a unit
/// quaternion (w, x, y, z) and a: 7+m numbers; its velocities V: 6+m.
struct FreeBody {
  std::string name;
  std::size_t index;  ///< index among the model's bodies
  BodyConstants constants;
  Eigen::Index position;
  Eigen::Index velocity;
};

struct SystemMarker {
  NodeConstants node;
  std::size_t free_body = JointPlace::kNoBody;        ///< index among the free bodies, or
  std::size_t prescribed_body = JointPlace::kNoBody;  ///< index among the prescribed ones
};

/// A model in the layout of the equations. Its state is a vector y = [Q; V; z; e]: positions and
/// velocities of the free bodies in the model's order, internal variables z of the force elements,
/// and two quadratures e: the energy that damping has dissipated and the work of forces and
/// prescribed bodies.
struct System {
  static constexpr Eigen::Index kQuadratures = 2;

  /// @param model  sound (see check()); must outlive this
  explicit System(const Model& model);

  const Model& model;
  std::vector<FreeBody> bodies;
  std::vector<PrescribedPath> prescribed;
  std::vector<SystemMarker> markers;
  std::vector<Joint> joints;
  std::vector<JointPlace> places;  ///< bodies and rows of the joints
  Eigen::Vector3d gravity_m_s2;

  Eigen::Index position_count = 0;
  Eigen::Index velocity_count = 0;
  Eigen::Index constraint_count = 0;
  Eigen::Index internal_count = 0;
  std::vector<InternalBlock> internal_blocks;
  /// Largest distance within a body, from its origin to a joint, or its radius; one if all are
  /// points.
  double size_m = 0;

  Eigen::Index state_count() const {
    return position_count + velocity_count + internal_count + kQuadratures;
  }
  /// The internal variables in a state.
  template <class State>
  auto internal(State&& state) const {
    return state.segment(position_count + velocity_count, internal_count);
  }
  std::vector<Eigen::Index> body_sizes() const;
  /// Displacement of the body per unit of each velocity, m, (velocity_count): the system's size for
  /// a radian, the root mean square over the mass for a modal coordinate.
  Eigen::VectorXd velocity_lengths_m() const;

  /// Q (+) dQ, equations.md section 5, with the exact exponential.
  void retract(Eigen::Ref<Eigen::VectorXd> positions,
               const Eigen::Ref<const Eigen::VectorXd>& change) const;
  void normalise(Eigen::Ref<Eigen::VectorXd> positions) const;
};

}  // namespace flexneck::multibody
