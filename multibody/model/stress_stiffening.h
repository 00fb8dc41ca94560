// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "multibody/model/model.h"

// Second-order terms of a body's invariants in its modal coordinates, from the geometric stiffness
// in its modes file (equations.md section 3a). All matrices are empty for a body without
// `stress_stiffening`.
namespace flexneck::multibody {

/// Slopes of shapes by the modal coordinates, (3m, m): rows 3l to 3l + 2 of column j are the
/// derivative of shape l by a_j. They are symmetric in j and l.
using ShapeSlopes = Eigen::MatrixXd;

/// Slopes of S2 and of N, the latter without the part from N's own N_jl.
struct InertiaSlopes {
  ShapeSlopes S2;
  ShapeSlopes N;
};
InertiaSlopes inertia_slopes(const DeformableBody& body);

/// Addition to the invariant G_jl, symmetric.
Eigen::Matrix3d inertia_curvature(const DeformableBody& body, Eigen::Index j, Eigen::Index l);

/// Slopes of psi and mu at an interface.
struct NodeSlopes {
  ShapeSlopes psi;
  ShapeSlopes mu;
};
NodeSlopes node_slopes(const DeformableBody& body, const std::string& interface);

/// The T_k of section 3a, one below the other: (m m, m), rows m k to m k + m - 1 are T_k.
Eigen::MatrixXd modal_curvatures(const DeformableBody& body);

/// Adds to the shapes, (3, m), their changes at the modal coordinates a.
template <typename Shapes, typename Modal>
void add_slopes(const ShapeSlopes& slopes, const Modal& a, Shapes& shapes) {
  for (Eigen::Index j = 0; j < a.size(); ++j)
    for (Eigen::Index l = 0; l < a.size(); ++l)
      shapes.col(l) += a[j] * slopes.template block<3, 1>(3 * l, j);
}

/// Returns sum_jl a_j b_l (derivative of shape l by a_j).
template <typename Modal, typename OtherModal>
Eigen::Vector3d contracted(const ShapeSlopes& slopes, const Modal& a, const OtherModal& b) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (Eigen::Index j = 0; j < a.size(); ++j)
    for (Eigen::Index l = 0; l < b.size(); ++l)
      sum += (a[j] * b[l]) * slopes.template block<3, 1>(3 * l, j);
  return sum;
}

/// Checks the data for stress stiffening.
/// @throws InputError if it is switched on for a body whose modes file lacks the data; `who` begins
/// the message.
void check_stress_stiffening(const std::string& who, const DeformableBody& body);

}  // namespace flexneck::multibody
