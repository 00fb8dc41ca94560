// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/results/report/head_shape.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

namespace flexneck::pipeline {

std::optional<HeadShape> head_shape(const Study& study) {
  const std::vector<multibody::Body>& bodies = study.model.model.bodies;
  const auto body = std::find_if(bodies.begin(), bodies.end(), [](const multibody::Body& each) {
    return each.name == "head" && std::holds_alternative<multibody::RigidBody>(each.kind);
  });
  if (body == bodies.end()) return {};
  const auto& head = std::get<multibody::RigidBody>(body->kind);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> principal(head.inertia_kg_m2);
  const Eigen::Array3d inertia = principal.eigenvalues();
  // I_x = m (b^2 + c^2) / 5 and so on, so a^2 = 5 (I_y + I_z - I_x) / (2 m).
  const Eigen::Array3d squares = 2.5 / head.mass_kg * (inertia.sum() - 2 * inertia);
  Eigen::Matrix3d turn = principal.eigenvectors();
  if (turn.determinant() < 0) turn.col(0) *= -1;
  return HeadShape{head.center_m, squares.max(0.0).sqrt().matrix(), Eigen::Quaterniond(turn)};
}

Eigen::Matrix2Xd outline_along_y(const HeadShape& shape, const Eigen::Matrix3d& head_to_view) {
  constexpr int kPoints = 72;
  const Eigen::Matrix3d axes = head_to_view * shape.rotation.toRotationMatrix();
  const Eigen::Matrix3d square =
      axes * shape.semi_axes_m.cwiseAbs2().asDiagonal() * axes.transpose();
  // The projection of the ellipsoid x^T S^-1 x = 1 has the matching rows and columns of S.
  Eigen::Matrix2d shadow;
  shadow << square(0, 0), square(0, 2), square(2, 0), square(2, 2);
  const Eigen::Matrix2d root = shadow.llt().matrixL();
  Eigen::Matrix2Xd outline(2, kPoints + 1);
  for (int k = 0; k <= kPoints; ++k) {
    const double angle = 2 * std::numbers::pi * k / kPoints;
    outline.col(k) = root * Eigen::Vector2d(std::cos(angle), std::sin(angle));
  }
  return outline;
}

}  // namespace flexneck::pipeline
