// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/reduction/slit_fields.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <Eigen/SVD>

#include "geometry/foundation/error.h"

namespace flexneck::fe_modal {
namespace {

/// Fraction of the largest jump below which a jump is zero.
constexpr double kNone = 1e-6;
/// Fraction of the largest opening below which pairs lie at the tip, where rounding determines the
/// direction in which they restrict the openings.
constexpr double kAtTip = 1e-3;

using Pairs = Eigen::Matrix3Xd;  ///< (3, p)

Pairs jumps_of(const mesher::Slit& slit, const Eigen::Matrix3Xd& shape) {
  return shape(Eigen::all, slit.upper) - shape(Eigen::all, slit.lower);
}

Pairs normals_of(const mesher::Slit& slit) {
  Pairs normals(3, static_cast<Eigen::Index>(slit.normals.size()));
  for (std::size_t p = 0; p < slit.normals.size(); ++p)
    normals.col(static_cast<Eigen::Index>(p)) = Eigen::Vector3d::Map(slit.normals[p].data());
  return normals;
}

/// Jumps of all shapes, (3 p, k), and their components along the normals, (p, k).
struct Jumps {
  Jumps(const mesher::Slit& slit, const std::vector<Eigen::Matrix3Xd>& shapes) {
    const Pairs normals = normals_of(slit);
    const auto count = static_cast<Eigen::Index>(shapes.size());
    along.resize(normals.cols(), count);
    whole.resize(normals.size(), count);
    across.resize(normals.size(), count);
    for (Eigen::Index k = 0; k < count; ++k) {
      const Pairs jumps = jumps_of(slit, shapes[static_cast<std::size_t>(k)]);
      along.col(k) = jumps.cwiseProduct(normals).colwise().sum().transpose();
      whole.col(k) = jumps.reshaped();
      across.col(k) = (jumps - normals * along.col(k).asDiagonal()).reshaped();
    }
  }

  Eigen::MatrixXd whole, along, across;
};

/// Sides, as columns, of the cone of combinations x of two openings, (p, 2), with openings * x >=
/// 0.
/// @throws InputError if only zero satisfies this
Eigen::Matrix2d sides_of_cone(const Eigen::MatrixX2d& openings, const std::string& slit) {
  const Eigen::Vector2d mean = openings.colwise().sum().normalized();
  const double largest = openings.rowwise().norm().maxCoeff();
  double least = 0;
  double most = 0;
  for (const auto& row : openings.rowwise()) {
    if (row.norm() < kAtTip * largest) continue;
    const double angle = std::atan2(mean.x() * row.y() - mean.y() * row.x(), row.dot(mean));
    least = std::min(least, angle);
    most = std::max(most, angle);
  }
  if (!(most - least < std::numbers::pi))
    throw InputError("slit '" + slit +
                     "' does not open over its whole face under any load on the interfaces");
  const double right_angle = std::numbers::pi / 2;
  Eigen::Matrix2d sides;
  sides << Eigen::Rotation2Dd(most - right_angle) * mean,
      Eigen::Rotation2Dd(least + right_angle) * mean;
  return sides;
}

/// Jumps that open the slit, with the accompanying motion of its free sides across the normals, (3
/// p, one or two).
Eigen::MatrixXd openings_of(const Jumps& jumps, const std::string& slit) {
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(jumps.along,
                                              Eigen::ComputeThinU | Eigen::ComputeThinV);
  const Eigen::VectorXd& strengths = svd.singularValues();
  if (!(strengths[0] > 0))
    throw InputError("slit '" + slit + "' does not open under any load on the interfaces");
  if (strengths.size() == 1 || strengths[1] < kNone * strengths[0]) {
    const double sign = svd.matrixU().col(0).sum() < 0 ? -1 : 1;
    return jumps.whole * (sign * svd.matrixV().col(0));
  }
  const Eigen::MatrixX2d both = svd.matrixU().leftCols<2>() * strengths.head<2>().asDiagonal();
  return jumps.whole * (svd.matrixV().leftCols<2>() * sides_of_cone(both, slit));
}

/// Independent jumps across the normals, (3 p, their number).
Eigen::MatrixXd slidings_of(const Eigen::MatrixXd& across, double strongest) {
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(across, Eigen::ComputeThinU);
  const Eigen::Index count = (svd.singularValues().array() > kNone * strongest).count();
  return svd.matrixU().leftCols(count);
}

Pairs with_largest_one(const Pairs& jumps) { return jumps / jumps.colwise().norm().maxCoeff(); }

}  // namespace

std::vector<SlitField> slit_fields(const mesher::Mesh& mesh,
                                   const std::vector<Eigen::Matrix3Xd>& shapes, bool with_sliding) {
  std::vector<SlitField> fields;
  for (std::size_t s = 0; s < mesh.slits.size(); ++s) {
    const mesher::Slit& slit = mesh.slits[s];
    if (slit.tied) continue;
    const Jumps jumps(slit, shapes);
    const Eigen::MatrixXd openings = openings_of(jumps, slit.name);
    const auto add = [&](const char* what, bool opens, const Eigen::MatrixXd& columns) {
      for (Eigen::Index k = 0; k < columns.cols(); ++k)
        fields.push_back({slit.name + what + std::to_string(k + 1), opens, s,
                          with_largest_one(columns.col(k).reshaped(3, columns.rows() / 3))});
    };
    add(" opens ", true, openings);
    if (with_sliding) add(" slides ", false, slidings_of(jumps.across, jumps.along.norm()));
  }
  return fields;
}

Eigen::Matrix3Xd on_nodes(const mesher::Mesh& mesh, const SlitField& field) {
  Eigen::Matrix3Xd nodes = Eigen::Matrix3Xd::Zero(3, static_cast<Eigen::Index>(mesh.nodes.size()));
  nodes(Eigen::all, mesh.slits.at(field.slit).upper) = field.jumps;
  return nodes;
}

std::vector<SlitMotion> slit_motions(const mesher::Mesh& mesh, const std::vector<SlitField>& fields,
                                     const std::vector<Eigen::Matrix3Xd>& shapes) {
  std::vector<SlitMotion> motions;
  for (std::size_t s = 0; s < mesh.slits.size(); ++s) {
    std::vector<const SlitField*> own;
    for (const SlitField& field : fields)
      if (field.slit == s) own.push_back(&field);
    if (own.empty()) continue;
    const mesher::Slit& slit = mesh.slits[s];
    const auto rows = static_cast<Eigen::Index>(3 * slit.upper.size());
    Eigen::MatrixXd basis(rows, static_cast<Eigen::Index>(own.size()));
    for (std::size_t k = 0; k < own.size(); ++k)
      basis.col(static_cast<Eigen::Index>(k)) = own[k]->jumps.reshaped();
    Eigen::MatrixXd jumps(rows, static_cast<Eigen::Index>(shapes.size()));
    for (std::size_t k = 0; k < shapes.size(); ++k)
      jumps.col(static_cast<Eigen::Index>(k)) = jumps_of(slit, shapes[k]).reshaped();
    const Eigen::MatrixXd amplitudes = basis.colPivHouseholderQr().solve(jumps);
    for (std::size_t k = 0; k < own.size(); ++k)
      motions.push_back(
          {own[k]->name, own[k]->opens, amplitudes.row(static_cast<Eigen::Index>(k))});
  }
  return motions;
}

}  // namespace flexneck::fe_modal
