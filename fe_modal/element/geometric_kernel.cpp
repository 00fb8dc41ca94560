// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/element/geometric_kernel.h"

#include "fe_modal/algebra/matrix_product.h"
#include "fe_modal/element/moduli.h"
#include "fe_modal/element/stressed_elements.h"

namespace flexneck::fe_modal {

void GeometricKernel::add(const Eigen::Matrix3Xd& nodes_m, const mesher::Material& material,
                          const Eigen::MatrixXd& displacements_m, Eigen::MatrixXd& stiffness) {
  kernel_.evaluate(nodes_m, material, displacements_m, fields_);
  kernel_.locate(nodes_m, points_, mass_points_);
  const Stresses stresses = stresses_of(fields_, moduli_of(material).mu, 0);
  const Eigen::Index n = nodes_m.cols();
  gradients_.resize(n, 3 * stresses.cols());
  weighted_.resize(n, 3 * stresses.cols());
  for (Eigen::Index q = 0; q < stresses.cols(); ++q) {
    const Eigen::Map<const Eigen::MatrixX3d> at_point(points_.gradients.col(q).data(), n, 3);
    gradients_.middleCols<3>(3 * q) = at_point;
    weighted_.middleCols<3>(3 * q) =
        at_point * (points_.volumes_m3[q] * tensor_of(stresses.col(q)));
  }
  sum_.resize(n, n);
  multiply_by_transpose(1, gradients_, weighted_, 0, sum_);
  for (Eigen::Index a = 0; a < 3; ++a) stiffness.block(a * n, a * n, n, n) += sum_;
}

}  // namespace flexneck::fe_modal
