// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/dofs/rigid_motions.h"

#include <algorithm>

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>

#include "fe_modal/body/skew.h"
#include "geometry/foundation/output_file.h"
#include "mesher/mesh/bounding_box.h"

namespace flexneck::fe_modal {
namespace {

using Six = Eigen::Matrix<double, 6, 6>;
using Motion = Eigen::Matrix<double, 3, 6>;

/// Largest sum of squares of a motion's violations of the constraints, relative to the motion, that
/// is rounding of positions in text files.
constexpr double kKept = 1e-12;

/// The six motions of a site about the body's centre, rotations times `length_m`.
class WholeBody {
 public:
  WholeBody(const mesher::Mesh& mesh, const mesher::Connections& connections)
      : mesh_(mesh), connections_(connections) {
    const mesher::BoundingBox box = mesher::bounding_box(mesh);
    center_m_ = box.center_m();
    length_m_ = box.extent_m().norm();
  }

  Motion at(std::int32_t site) const {
    Motion motion = Motion::Zero();
    if (is_rotation(site)) {
      motion.rightCols<3>() = Eigen::Matrix3d::Identity() / length_m_;
      return motion;
    }
    const auto nodes = static_cast<std::int32_t>(mesh_.nodes.size());
    const auto& x =
        site < nodes ? mesh_.nodes[static_cast<std::size_t>(site)]
                     : connections_.points[static_cast<std::size_t>(site - nodes) / 2].position_m;
    motion = rigid_motions_at(Eigen::Vector3d(x.data()) - center_m_);
    motion.rightCols<3>() /= length_m_;
    return motion;
  }
  bool is_rotation(std::int32_t site) const {
    const auto nodes = static_cast<std::int32_t>(mesh_.nodes.size());
    return site >= nodes && (site - nodes) % 2 == 1;
  }
  double length_m() const { return length_m_; }

 private:
  const mesher::Mesh& mesh_;
  const mesher::Connections& connections_;
  Eigen::Vector3d center_m_;
  double length_m_;
};

/// The six motions as values of the blocks of degrees of freedom, and the motions of a site that
/// the constraints make of them. A block has the motion of one of the sites that share it: the
/// other sites show the violation.
class ConstrainedMotions {
 public:
  ConstrainedMotions(const WholeBody& body, const DofMap& dof_map)
      : dof_map_(dof_map), values_(dof_map.dof_count(), 6), sizes_(dof_map.dof_count()) {
    for (auto site = static_cast<std::int32_t>(dof_map.site_count()); site-- > 0;) {
      if (dof_map.index(site) < 0) continue;
      values_.middleRows<3>(3 * dof_map.index(site)) = body.at(site);
      sizes_.segment<3>(3 * dof_map.index(site))
          .setConstant(body.is_rotation(site) ? 1 / body.length_m() : 1);
    }
  }

  /// Values of all blocks, (dofs, 6).
  const Eigen::Matrix<double, Eigen::Dynamic, 6>& values() const { return values_; }
  Motion at(std::int32_t site) const {
    Motion motion;
    for (Eigen::Index k = 0; k < 6; ++k) motion.col(k) = dof_map_.motion_of(site, values_.col(k));
    return motion;
  }
  /// Displacement of each direction of a site when all degrees of freedom move by the body's size:
  /// violations of constraints are relative to it, whatever the sizes of their coefficients.
  Eigen::Vector3d sizes_at(std::int32_t site) const {
    if (dof_map_.is_plain(site)) return Eigen::Vector3d::Ones();
    Eigen::Vector3d squares = Eigen::Vector3d::Zero();
    for (int a = 0; a < 3; ++a) {
      for (const DofTerm& term : dof_map_.terms(site, a)) {
        const double size = term.coefficient * sizes_[term.dof];
        squares[a] += size * size;
      }
    }
    return squares.cwiseSqrt();
  }

 private:
  const DofMap& dof_map_;
  Eigen::Matrix<double, Eigen::Dynamic, 6> values_;
  Eigen::VectorXd sizes_;
};

/// Text of the directions that vectors span: "x", "x and y", "(0.6, 0.8, 0)", "every direction".
std::string directions(const Eigen::Matrix3Xd& span, const std::string& every) {
  if (span.cols() == 3) return every;
  constexpr double kSame = 1e-6;
  const Eigen::Matrix3d projector = span * span.transpose();
  std::string text;
  Eigen::Index found = 0;
  for (Eigen::Index a = 0; a < 3; ++a) {
    if (projector(a, a) < 1 - kSame) continue;
    ++found;
    text += (text.empty() ? "" : " and ") + std::string(1, "xyz"[a]);
  }
  if (found == span.cols()) return text;
  text.clear();
  for (const auto& column : span.colwise()) {
    text += (text.empty() ? "(" : " and (") + rounded_texts({column.data(), 3}, 3) + ")";
  }
  return text;
}

}  // namespace

RigidMotions::RigidMotions(const mesher::Mesh& mesh, const mesher::Connections& connections,
                           const DofMap& dof_map) {
  const WholeBody body(mesh, connections);
  const ConstrainedMotions constrained(body, dof_map);
  Six residuals = Six::Zero();
  for (std::int32_t node = 0; node < static_cast<std::int32_t>(dof_map.node_count()); ++node) {
    const Motion residual = constrained.sizes_at(node).cwiseMax(1).cwiseInverse().asDiagonal() *
                            (constrained.at(node) - body.at(node));
    residuals += residual.transpose() * residual;
  }
  for (const mesher::Spring& spring : connections.springs) {
    Eigen::Matrix<double, 1, 6> elongation = Eigen::Matrix<double, 1, 6>::Zero();
    double size = 0;
    for (const mesher::Term& term : spring.terms) {
      const Eigen::Vector3d coefficients(term.coefficients.data());
      elongation += coefficients.transpose() * constrained.at(term.site);
      size += coefficients.norm() / (body.is_rotation(term.site) ? body.length_m() : 1);
    }
    elongation /= size;
    residuals += elongation.transpose() * elongation;
  }
  const Eigen::SelfAdjointEigenSolver<Six> spectrum(residuals);
  const Eigen::Index count = (spectrum.eigenvalues().array() <= kKept).count();
  motions_ = spectrum.eigenvectors().leftCols(count);
}

Eigen::MatrixXd RigidMotions::vectors(const mesher::Mesh& mesh,
                                      const mesher::Connections& connections,
                                      const DofMap& dof_map) const {
  const WholeBody body(mesh, connections);
  Eigen::MatrixXd vectors = ConstrainedMotions(body, dof_map).values() * motions_;
  for (Eigen::Index row = 0; row < vectors.rows(); ++row)
    if (dof_map.is_dependent(static_cast<std::int32_t>(row / 3), row % 3))
      vectors.row(row).setZero();
  return vectors;
}

std::string RigidMotions::text() const {
  if (count() == 0) return {};
  constexpr double kNone = 1e-6;
  const Eigen::JacobiSVD<Eigen::MatrixXd> rotations(motions_.bottomRows<3>(),
                                                    Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::Index turns = (rotations.singularValues().array() > kNone).count();
  const Eigen::Matrix3Xd slides =
      motions_.topRows<3>() * rotations.matrixV().rightCols(count() - turns);
  std::string text;
  if (slides.cols() > 0) text = "slides along " + directions(slides, "every direction");
  if (turns > 0) {
    text += (text.empty() ? "rotates about " : ", rotates about ") +
            directions(rotations.matrixU().leftCols(turns), "every axis");
  }
  return text;
}

}  // namespace flexneck::fe_modal
