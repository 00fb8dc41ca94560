// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/dofs/point_element.h"

#include "fe_modal/dofs/rigid_mass.h"

namespace flexneck::fe_modal {
namespace {

/// Element of a spring, k e^T e with e the row of the elongation; terms of the same site add.
PointElement element_of(const mesher::Spring& spring) {
  PointElement element;
  const auto n = static_cast<Eigen::Index>(spring.terms.size());
  Eigen::VectorXd elongation = Eigen::VectorXd::Zero(3 * n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const mesher::Term& term = spring.terms[static_cast<std::size_t>(i)];
    element.sites.push_back(term.site);
    for (Eigen::Index a = 0; a < 3; ++a) {
      elongation[a * n + i] = term.coefficients[static_cast<std::size_t>(a)];
    }
  }
  element.stiffness = spring.stiffness * elongation * elongation.transpose();
  element.mass = Eigen::MatrixXd::Zero(3 * n, 3 * n);
  return element;
}

PointElement element_of(const mesher::PointMass& mass, std::size_t node_count) {
  if (static_cast<std::size_t>(mass.site) < node_count) {
    return {{mass.site}, Eigen::Matrix3d::Zero(), mass.mass_kg * Eigen::Matrix3d::Identity()};
  }
  PointElement element{{mass.site, mass.site + 1}, Eigen::MatrixXd::Zero(6, 6), {}};
  element.mass.resize(6, 6);
  // Translation (3) and rotation (3).
  const Eigen::Matrix<double, 6, 6> matrix = mass_matrix_of(mass);
  for (Eigen::Index i = 0; i < 6; ++i) {
    for (Eigen::Index j = 0; j < 6; ++j) {
      element.mass(i % 3 * 2 + i / 3, j % 3 * 2 + j / 3) = matrix(i, j);
    }
  }
  return element;
}

}  // namespace

std::vector<PointElement> point_elements_of(const mesher::Connections& connections,
                                            std::size_t node_count) {
  std::vector<PointElement> elements;
  for (const mesher::Spring& spring : connections.springs) elements.push_back(element_of(spring));
  for (const mesher::PointMass& mass : connections.masses) {
    elements.push_back(element_of(mass, node_count));
  }
  return elements;
}

}  // namespace flexneck::fe_modal
