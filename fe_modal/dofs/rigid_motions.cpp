// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/dofs/rigid_motions.h"

#include <algorithm>
#include <array>
#include <cstdio>

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>

#include "fe_modal/body/skew.h"
#include "mesher/mesh/bounding_box.h"

namespace flexneck::fe_modal {
namespace {

using Six = Eigen::Matrix<double, 6, 6>;
using Motion = Eigen::Matrix<double, 3, 6>;

/// A residual below this share of the largest, or of a unit motion, squared, is rounding of
/// positions in text files.
constexpr double kKept = 1e-12;

/// The six motions of a site, rotations times `length_m`.
class WholeBody {
 public:
  WholeBody(const mesher::Mesh& mesh, const mesher::Connections& connections)
      : mesh_(mesh),
        connections_(connections),
        length_m_(mesher::bounding_box(mesh).extent_m().norm()) {}

  Motion at(std::int32_t site) const {
    const auto nodes = static_cast<std::int32_t>(mesh_.nodes.size());
    Motion motion = Motion::Zero();
    if (site >= nodes && (site - nodes) % 2 == 1) {
      motion.rightCols<3>() = Eigen::Matrix3d::Identity() / length_m_;
      return motion;
    }
    const auto& x =
        site < nodes ? mesh_.nodes[static_cast<std::size_t>(site)]
                     : connections_.points[static_cast<std::size_t>(site - nodes) / 2].position_m;
    motion = rigid_motions_at(Eigen::Vector3d(x.data()));
    motion.rightCols<3>() /= length_m_;
    return motion;
  }

 private:
  const mesher::Mesh& mesh_;
  const mesher::Connections& connections_;
  double length_m_;
};

/// "x", "x and y", "(0.6, 0.8, 0)", "every direction"
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
    std::array<char, 64> vector{};
    std::snprintf(vector.data(), vector.size(), "(%.3g, %.3g, %.3g)", column[0], column[1],
                  column[2]);
    text += (text.empty() ? "" : " and ") + std::string(vector.data());
  }
  return text;
}

}  // namespace

RigidMotions::RigidMotions(const mesher::Mesh& mesh, const mesher::Connections& connections,
                           const DofMap& dof_map) {
  const WholeBody body(mesh, connections);
  // The free values that a rigid motion has, and where constraints make another motion of them.
  Eigen::Matrix<double, Eigen::Dynamic, 6> values(dof_map.dof_count(), 6);
  const auto sites = static_cast<std::int32_t>(dof_map.site_count());
  for (std::int32_t site = sites; site-- > 0;) {
    if (dof_map.index(site) >= 0) values.middleRows<3>(3 * dof_map.index(site)) = body.at(site);
  }
  const auto moved = [&](std::int32_t site) {
    Motion motion;
    for (Eigen::Index k = 0; k < 6; ++k) motion.col(k) = dof_map.motion_of(site, values.col(k));
    return motion;
  };
  Six residuals = Six::Zero();
  for (std::int32_t node = 0; node < static_cast<std::int32_t>(dof_map.node_count()); ++node) {
    if (dof_map.is_plain(node) && dof_map.index(node) >= 0) continue;
    const Motion residual = moved(node) - body.at(node);
    residuals += residual.transpose() * residual;
  }
  for (const mesher::Spring& spring : connections.springs) {
    Eigen::Matrix<double, 1, 6> elongation = Eigen::Matrix<double, 1, 6>::Zero();
    double size = 0;
    for (const mesher::Term& term : spring.terms) {
      const Eigen::Vector3d coefficients(term.coefficients.data());
      elongation += coefficients.transpose() * moved(term.site);
      size += coefficients.norm();
    }
    elongation /= size;
    residuals += elongation.transpose() * elongation;
  }
  const Eigen::SelfAdjointEigenSolver<Six> spectrum(residuals);
  const double largest = spectrum.eigenvalues()[5];
  const Eigen::Index count =
      (spectrum.eigenvalues().array() <= kKept * std::max(largest, 1.0)).count();
  motions_ = spectrum.eigenvectors().leftCols(count);
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
    text += (text.empty() ? "turns about " : ", turns about ") +
            directions(rotations.matrixU().leftCols(turns), "every axis");
  }
  return text;
}

}  // namespace flexneck::fe_modal
