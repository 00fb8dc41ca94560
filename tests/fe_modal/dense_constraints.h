// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include <Eigen/Geometry>

#include "fe_modal/system/assembly.h"
#include "tests/fe_modal/dense.h"
#include "tests/support/dense_solvers.h"

/// Constraints, masses and springs of a mesh as dense matrices, implemented independently.
namespace flexneck::fe_modal {

/// Dense model with degrees of freedom 3 site + a, sites being counted as in
/// mesher/mesh/connections.h.
struct DenseConstraints {
  Eigen::MatrixXd stiffness, mass;
  std::vector<Eigen::VectorXd> equations;  ///< rows: sum of entries times degrees of freedom = 0
};

inline Eigen::Vector3d point_of(const std::array<double, 3>& x) {
  return Eigen::Vector3d(x.data());
}

inline void add_couplings(const mesher::Mesh& mesh, DenseConstraints& model) {
  const auto n = static_cast<Eigen::Index>(mesh.nodes.size());
  for (const mesher::Coupling& coupling : mesh.connections.couplings) {
    const Eigen::Index point = n + 2 * coupling.point;
    for (const std::int32_t node : coupling.nodes) {
      const Eigen::Vector3d arm =
          point_of(mesh.nodes[static_cast<std::size_t>(node)]) -
          point_of(mesh.connections.points[static_cast<std::size_t>(coupling.point)].position_m);
      for (Eigen::Index a = 0; a < 3; ++a) {
        if (!coupling.directions[static_cast<std::size_t>(a)]) continue;
        Eigen::VectorXd row = Eigen::VectorXd::Zero(model.stiffness.rows());
        row[3 * node + a] = -1;
        row[3 * point + a] = 1;
        for (Eigen::Index k = 0; k < 3; ++k) {  // e_a . (e_k x arm)
          row[3 * (point + 1) + k] = Eigen::Vector3d::Unit(k).cross(arm)[a];
        }
        model.equations.push_back(row);
      }
    }
  }
}

inline Eigen::VectorXd row_of(const std::vector<mesher::Term>& terms, Eigen::Index size) {
  Eigen::VectorXd row = Eigen::VectorXd::Zero(size);
  for (const mesher::Term& term : terms) {
    row.segment<3>(3 * static_cast<Eigen::Index>(term.site)) += point_of(term.coefficients);
  }
  return row;
}

/// Fixes motions without stiffness and mass, such as the rotation of a point that only springs
/// hold.
inline void fix_what_nothing_feels(DenseConstraints& model) {
  const Eigen::Index size = model.stiffness.rows();
  for (Eigen::Index k = 0; k < size; ++k) {
    bool is_felt = !model.stiffness.row(k).isZero(0) || !model.mass.row(k).isZero(0);
    for (const Eigen::VectorXd& row : model.equations) is_felt = is_felt || row[k] != 0;
    if (!is_felt) model.equations.push_back(Eigen::VectorXd::Unit(size, k));
  }
}

/// Dense model of the whole structure, its matrices without the constraints.
inline DenseConstraints dense_model(const mesher::Mesh& mesh) {
  mesher::Mesh bare = mesh;
  bare.connections = {};
  const SystemMatrices system = assemble(bare, DofMap(bare, {}));
  const auto n = static_cast<Eigen::Index>(mesh.nodes.size());
  const mesher::Connections& connections = mesh.connections;
  const Eigen::Index size = 3 * (n + 2 * static_cast<Eigen::Index>(connections.points.size()));
  DenseConstraints model{Eigen::MatrixXd::Zero(size, size), Eigen::MatrixXd::Zero(size, size), {}};
  model.stiffness.topLeftCorner(3 * n, 3 * n) = dense(system.stiffness.get());
  model.mass.topLeftCorner(3 * n, 3 * n) = dense(system.mass.get());
  add_couplings(mesh, model);
  for (const mesher::Equation& equation : connections.equations) {
    model.equations.push_back(row_of(equation.terms, size));
  }
  for (const mesher::Support& support : connections.supports) {
    for (const std::int32_t node : support.nodes) {
      const Eigen::Matrix3d axes =
          support.axes.at(point_of(mesh.nodes[static_cast<std::size_t>(node)]));
      for (Eigen::Index d = 0; d < 3; ++d) {
        if (!support.directions[static_cast<std::size_t>(d)]) continue;
        Eigen::VectorXd row = Eigen::VectorXd::Zero(size);
        row.segment<3>(3 * static_cast<Eigen::Index>(node)) = axes.col(d);
        model.equations.push_back(row);
      }
    }
  }
  for (const mesher::Spring& spring : connections.springs) {
    const Eigen::VectorXd row = row_of(spring.terms, size);
    model.stiffness += spring.stiffness * row * row.transpose();
  }
  for (const mesher::PointMass& mass : connections.masses) {
    const Eigen::Index first = 3 * static_cast<Eigen::Index>(mass.site);
    if (mass.site < n) {
      model.mass.block<3, 3>(first, first) += mass.mass_kg * Eigen::Matrix3d::Identity();
      continue;
    }
    // Kinetic energy is that of the centre's velocity v + w x c, by columns.
    Eigen::Matrix<double, 3, 6> center = Eigen::Matrix<double, 3, 6>::Zero();
    for (Eigen::Index k = 0; k < 3; ++k) {
      center.col(k) = Eigen::Vector3d::Unit(k);
      center.col(3 + k) = Eigen::Vector3d::Unit(k).cross(point_of(mass.center_m));
    }
    model.mass.block<6, 6>(first, first) += mass.mass_kg * center.transpose() * center;
    const auto& i = mass.inertia_kg_m2;
    Eigen::Matrix3d inertia;
    inertia << i[0], i[3], i[4], i[3], i[1], i[5], i[4], i[5], i[2];
    model.mass.block<3, 3>(first + 3, first + 3) += inertia;
  }
  fix_what_nothing_feels(model);
  return model;
}

/// Basis, in columns, of all motions that satisfy the equations.
inline Eigen::MatrixXd allowed_motions(const DenseConstraints& model) {
  const Eigen::Index size = model.stiffness.rows();
  if (model.equations.empty()) return Eigen::MatrixXd::Identity(size, size);
  Eigen::MatrixXd equations(static_cast<Eigen::Index>(model.equations.size()), size);
  for (std::size_t k = 0; k < model.equations.size(); ++k) {
    equations.row(static_cast<Eigen::Index>(k)) = model.equations[k];
  }
  return testing::null_space(equations);
}

}  // namespace flexneck::fe_modal
