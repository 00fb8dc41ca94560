// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/dofs/held_points.h"

#include <algorithm>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include "fe_modal/body/skew.h"
#include "fe_modal/dofs/rigid_mass.h"
#include "geometry/foundation/error.h"
#include "mesher/mesh/bounding_box.h"

namespace flexneck::fe_modal {
namespace {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

/// Fraction of the largest eigenvalue, of squares of displacements per unit motion, below which a
/// motion displaces nothing.
constexpr double kNothing = 1e-10;

/// Resistance of the connections to a point's motion, and the mass at the point.
struct Point {
  double length_m = 0;  ///< longest arm of its nodes
  Matrix6d felt = Matrix6d::Zero();
  Matrix6d mass = Matrix6d::Zero();
};

class Points {
 public:
  Points(const mesher::Mesh& mesh, const mesher::Connections& connections)
      : mesh_(mesh), connections_(connections), points_(connections.points.size()) {
    const double whole_m = mesher::bounding_box(mesh).extent_m().norm();
    for (const mesher::Coupling& coupling : connections.couplings) {
      for (const std::int32_t node : coupling.nodes) {
        double& length_m = of(coupling.point).length_m;
        length_m = std::max(length_m, arm(coupling, node).norm());
      }
    }
    for (Point& point : points_) {
      if (!(point.length_m > 0)) point.length_m = whole_m;
    }
    for (const mesher::Coupling& coupling : connections.couplings) add(coupling);
    for (const mesher::Equation& equation : connections.equations) add(equation.terms);
    for (const mesher::Spring& spring : connections.springs) add(spring.terms);
    for (const mesher::PointMass& mass : connections.masses) {
      if (!is_node(mass.site)) points_[point_of(mass.site)].mass += mass_matrix_of(mass);
    }
  }

  const std::vector<Point>& all() const { return points_; }

 private:
  bool is_node(std::int32_t site) const {
    return static_cast<std::size_t>(site) < mesh_.nodes.size();
  }
  std::size_t point_of(std::int32_t site) const {
    return (static_cast<std::size_t>(site) - mesh_.nodes.size()) / 2;
  }
  Point& of(std::int32_t point) { return points_[static_cast<std::size_t>(point)]; }
  Eigen::Vector3d arm(const mesher::Coupling& coupling, std::int32_t node) const {
    const auto& point = connections_.points[static_cast<std::size_t>(coupling.point)];
    return Eigen::Map<const Eigen::Vector3d>(mesh_.nodes[static_cast<std::size_t>(node)].data()) -
           Eigen::Map<const Eigen::Vector3d>(point.position_m.data());
  }

  void add(const mesher::Coupling& coupling) {
    Point& point = of(coupling.point);
    for (const std::int32_t node : coupling.nodes) {
      const Eigen::Matrix<double, 3, 6> motion =
          rigid_motions_at(arm(coupling, node) / point.length_m);
      for (Eigen::Index a = 0; a < 3; ++a) {
        if (!coupling.directions[static_cast<std::size_t>(a)]) continue;
        point.felt += motion.row(a).transpose() * motion.row(a);
      }
    }
  }

  void add(const std::vector<mesher::Term>& terms) {
    for (const mesher::Term& term : terms) {
      if (is_node(term.site)) continue;
      const bool is_rotation = (static_cast<std::size_t>(term.site) - mesh_.nodes.size()) % 2 == 1;
      Vector6d row = Vector6d::Zero();
      row.segment<3>(is_rotation ? 3 : 0) =
          Eigen::Map<const Eigen::Vector3d>(term.coefficients.data()).normalized();
      points_[point_of(term.site)].felt += row * row.transpose();
    }
  }

  const mesher::Mesh& mesh_;
  const mesher::Connections& connections_;
  std::vector<Point> points_;
};

}  // namespace

void hold_points(const mesher::Mesh& mesh, const mesher::Connections& connections,
                 AffineConstraints& constraints) {
  const Points points(mesh, connections);
  for (std::size_t p = 0; p < points.all().size(); ++p) {
    const Point& point = points.all()[p];
    const Eigen::SelfAdjointEigenSolver<Matrix6d> motions(point.felt);
    const double largest = motions.eigenvalues()[5];
    for (Eigen::Index k = 0; k < 6; ++k) {
      if (largest > 0 && motions.eigenvalues()[k] > kNothing * largest) break;
      Vector6d motion = motions.eigenvectors().col(k);  // rotations are scaled to lengths
      motion.tail<3>() /= point.length_m;
      if ((point.mass * motion).norm() > kNothing * point.mass.norm() * motion.norm()) {
        throw InputError(connections.points[p].name +
                         " carries a mass with an unconstrained motion; couple at least three "
                         "nodes that are not on one line to it, or add springs");
      }
      std::vector<DofTerm> terms;
      const std::int32_t first =
          3 * mesher::translation_site(mesh.nodes.size(), static_cast<std::int32_t>(p));
      motion.tail<3>() *= point.length_m * point.length_m;
      for (std::int32_t i = 0; i < 6; ++i) {
        if (std::abs(motion[i]) > kNothing * motion.norm()) terms.push_back({first + i, motion[i]});
      }
      constraints.add_equation(terms, "a motion of " + connections.points[p].name);
    }
  }
}

}  // namespace flexneck::fe_modal
