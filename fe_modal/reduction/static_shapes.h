// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "fe_modal/body/modal_body.h"
#include "fe_modal/reduction/operators.h"
#include "fe_modal/solve/eigensolver.h"
#include "fe_modal/system/field_map.h"
#include "fe_modal/system/rigid_average.h"
#include "geometry/foundation/progress.h"

namespace flexneck::fe_modal {

/// Six unit loads on one interface, force (3) and moment (3), distributed so that their work is
/// that of the interface's average motion.
struct InterfaceLoads {
  std::string name;
  Eigen::MatrixXd forces;      ///< C^T, (own dofs, 6)
  bool corrects_basis = true;  ///< true if static shapes of this interface join the basis
};

/// Loads of an interface on the free degrees of freedom.
InterfaceLoads interface_loads(const std::string& name, const RigidAverage& average,
                               const FieldMap& field_map);

/// Static shapes of all interfaces' loads, less the part of some modes.
struct StaticShapes {
  Eigen::MatrixXd loads;       ///< F, (dofs, 6 p)
  Eigen::MatrixXd beyond;      ///< X less the modes' part, (dofs, 6 p)
  Eigen::MatrixXd rest;        ///< F^T times the shapes beyond the modes
  Eigen::VectorXd compliance;  ///< diagonal of F^T X
  std::vector<StaticResponse> responses;
};

StaticShapes static_shapes(const BodyOperators& body, const EigenPairs& kept,
                           const std::vector<InterfaceLoads>& interfaces);

/// Combinations of the loads on interfaces that correct the basis, (6 p, k): their shapes are
/// K-orthonormal. Reports the number of dropped ones.
Eigen::MatrixXd correcting_loads(const StaticShapes& shapes,
                                 const std::vector<InterfaceLoads>& interfaces,
                                 const Progress& progress);

}  // namespace flexneck::fe_modal
