// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/point_mass_body.h"

#include <cmath>
#include <utility>

namespace flexneck::testing {
namespace {

Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& v) {
  Eigen::Matrix3d result;
  result << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return result;
}

/// Makes the shapes orthonormal in the masses, so that Maa = I.
void mass_orthonormalise(const Eigen::VectorXd& masses, std::vector<Eigen::Matrix3Xd>& shapes) {
  const auto product = [&](const Eigen::Matrix3Xd& a, const Eigen::Matrix3Xd& b) {
    return (a.cwiseProduct(b) * masses).sum();
  };
  for (int pass = 0; pass < 2; ++pass)
    for (std::size_t l = 0; l < shapes.size(); ++l) {
      for (std::size_t j = 0; j < l; ++j) shapes[l] -= product(shapes[j], shapes[l]) * shapes[j];
      shapes[l] /= std::sqrt(product(shapes[l], shapes[l]));
    }
}

/// Geometric stiffness of loads: minus their work on the second-order displacements.
Eigen::MatrixXd work_on(const std::vector<Eigen::Matrix3Xd>& second_shapes,
                        const Eigen::Matrix3Xd& loads) {
  const auto m = static_cast<Eigen::Index>(std::lround(std::sqrt(second_shapes.size())));
  Eigen::MatrixXd work(m, m);
  for (Eigen::Index j = 0; j < m; ++j)
    for (Eigen::Index l = 0; l < m; ++l)
      work(j, l) = -loads.cwiseProduct(second_shapes[static_cast<std::size_t>(j * m + l)]).sum();
  return work;
}

/// Adds random second-order displacements and rotations, a few centimetres at coordinates of 0.1,
/// and the corresponding geometric stiffness.
void add_second_order(unsigned seed, PointMassBody& points) {
  fe_modal::ModalBody& body = points.body;
  const Eigen::Index m = body.mode_count();
  RandomNumbers random(seed);
  const auto symmetric = [&] {
    Eigen::MatrixXd matrix(m, m);
    random.fill(matrix);
    return Eigen::MatrixXd(matrix + matrix.transpose());
  };
  points.second_shapes.assign(static_cast<std::size_t>(m * m),
                              Eigen::Matrix3Xd(3, points.point_count()));
  for (Eigen::Index k = 0; k < points.point_count(); ++k)
    for (Eigen::Index i = 0; i < 3; ++i) {
      const Eigen::MatrixXd values = 2 * symmetric();
      for (Eigen::Index j = 0; j < m; ++j)
        for (Eigen::Index l = 0; l < m; ++l)
          points.second_shapes[static_cast<std::size_t>(j * m + l)](i, k) = values(j, l);
    }
  body.geometric_stiffness = inertial_stiffness_of_points(points.masses_kg, body.nodes_m,
                                                          body.shapes, points.second_shapes);
  for (const auto& [name, point] : {std::pair("tip", points.point_count() - 1), {"side", 0}}) {
    fe_modal::GeometricStiffness::OfInterface loads{name, {}, {}};
    for (Eigen::Index i = 0; i < 3; ++i) {
      Eigen::Matrix3Xd force = Eigen::Matrix3Xd::Zero(3, points.point_count());
      force(i, point) = 1;
      loads.force.push_back(work_on(points.second_shapes, force));
      loads.moment.push_back(10 * symmetric());
    }
    body.geometric_stiffness->interfaces.push_back(loads);
  }
}

}  // namespace

Eigen::Vector3d PointMassBody::point(Eigen::Index k, const Eigen::VectorXd& a) const {
  Eigen::Vector3d s = body.nodes_m.col(k);
  for (std::size_t l = 0; l < body.shapes.size(); ++l)
    s += a[static_cast<Eigen::Index>(l)] * body.shapes[l].col(k);
  return s;
}

double PointMassBody::modal_share(std::size_t k, const Eigen::VectorXd& a) const {
  return a.dot(body.geometric_stiffness->modal_acceleration[k] * a) / 2;
}

Eigen::Vector3d PointMassBody::second_order(Eigen::Index k, const Eigen::VectorXd& a) const {
  Eigen::Vector3d s = Eigen::Vector3d::Zero();
  for (std::size_t l = 0; l < body.shapes.size(); ++l)
    s -= modal_share(l, a) * body.shapes[l].col(k);
  for (Eigen::Index j = 0; j < a.size(); ++j)
    for (Eigen::Index l = 0; l < a.size(); ++l)
      s += 0.5 * a[j] * a[l] * second_shapes[static_cast<std::size_t>(j * a.size() + l)].col(k);
  return s;
}

fe_modal::InertiaInvariants invariants_of_points(const Eigen::VectorXd& masses,
                                                 const Eigen::Matrix3Xd& points,
                                                 const std::vector<Eigen::Matrix3Xd>& shapes) {
  const std::size_t m = shapes.size();
  const auto size = static_cast<Eigen::Index>(m);
  fe_modal::InertiaInvariants sums;
  sums.mass = masses.sum();
  sums.S1 = points * masses;
  sums.S2.setZero(3, size);
  sums.J0.setZero();
  sums.G0.assign(m, Eigen::Matrix3d::Zero());
  sums.G.assign(m * m, Eigen::Matrix3d::Zero());
  sums.N0.setZero(3, size);
  sums.N.assign(m * m, Eigen::Vector3d::Zero());
  sums.Maa.setZero(size, size);
  for (Eigen::Index k = 0; k < masses.size(); ++k) {
    const double mass = masses[k];
    const Eigen::Matrix3d s = cross_matrix(points.col(k));
    sums.J0 -= mass * s * s;
    for (std::size_t l = 0; l < m; ++l) {
      const Eigen::Vector3d psi_l = shapes[l].col(k);
      const auto column = static_cast<Eigen::Index>(l);
      sums.S2.col(column) += mass * psi_l;
      sums.G0[l] -= mass * s * cross_matrix(psi_l);
      sums.N0.col(column) += mass * s * psi_l;
      for (std::size_t j = 0; j < m; ++j) {
        const Eigen::Matrix3d psi_j = cross_matrix(shapes[j].col(k));
        sums.G[j * m + l] -= mass * psi_j * cross_matrix(psi_l);
        sums.N[j * m + l] += mass * psi_j * psi_l;
        sums.Maa(static_cast<Eigen::Index>(j), column) += mass * shapes[j].col(k).dot(psi_l);
      }
    }
  }
  return sums;
}

fe_modal::GeometricStiffness inertial_stiffness_of_points(
    const Eigen::VectorXd& masses, const Eigen::Matrix3Xd& points,
    const std::vector<Eigen::Matrix3Xd>& shapes,
    const std::vector<Eigen::Matrix3Xd>& second_shapes) {
  fe_modal::GeometricStiffness stiffness;
  const auto of_field = [&](const auto& acceleration_at) {
    Eigen::Matrix3Xd loads(3, points.cols());
    for (Eigen::Index k = 0; k < points.cols(); ++k)
      loads.col(k) = -masses[k] * acceleration_at(Eigen::Vector3d(points.col(k)));
    return work_on(second_shapes, loads);
  };
  const Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  for (Eigen::Index i = 0; i < 3; ++i) {
    const Eigen::Vector3d e = axes.col(i);
    stiffness.acceleration.push_back(of_field([&](const Eigen::Vector3d&) { return e; }));
    stiffness.angular_acceleration.push_back(
        of_field([&](const Eigen::Vector3d& s) -> Eigen::Vector3d { return e.cross(s); }));
  }
  // A product of different components occurs twice in w x (w x s).
  for (const auto& [i, j] : {std::pair(0, 0), {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}}) {
    const Eigen::Vector3d e = axes.col(i);
    const Eigen::Vector3d f = axes.col(j);
    const double share = i == j ? 0.5 : 1;
    stiffness.velocity_products.push_back(
        of_field([&](const Eigen::Vector3d& s) -> Eigen::Vector3d {
          return share * (e.cross(f.cross(s)) + f.cross(e.cross(s)));
        }));
  }
  for (const Eigen::Matrix3Xd& shape : shapes)
    stiffness.modal_acceleration.push_back(work_on(second_shapes, -shape * masses.asDiagonal()));
  return stiffness;
}

PointMassBody make_point_mass_body(unsigned seed, int mode_count, int point_count) {
  RandomNumbers random(seed);
  PointMassBody result;
  result.masses_kg = 0.15 * (random.vector(point_count).array() + 1.2).matrix();
  fe_modal::ModalBody& body = result.body;
  body.nodes_m.resize(3, point_count);
  random.fill(body.nodes_m);
  body.nodes_m *= 0.1;
  body.nodes_m.row(2).array() += 0.08;
  body.shapes.assign(static_cast<std::size_t>(mode_count), Eigen::Matrix3Xd(3, point_count));
  for (Eigen::Matrix3Xd& shape : body.shapes) random.fill(shape);
  mass_orthonormalise(result.masses_kg, body.shapes);

  body.frequencies_Hz.resize(mode_count);
  for (int l = 0; l < mode_count; ++l) {
    body.frequencies_Hz[l] = 4.0 + 3.0 * l;
    body.modes.push_back({"mode " + std::to_string(l + 1), "normal", {}, 0.0});
  }
  body.boundary = "free points on a moving frame";
  body.completeness = "not checked";
  body.invariants = invariants_of_points(result.masses_kg, body.nodes_m, body.shapes);

  const Eigen::Matrix3Xd none = Eigen::Matrix3Xd::Zero(3, mode_count);
  body.interfaces.push_back({"root", Eigen::Vector3d::Zero(), none, none});
  for (const auto& [name, point] : {std::pair("tip", point_count - 1), std::pair("side", 0)}) {
    Eigen::Matrix3Xd translation(3, mode_count);
    Eigen::Matrix3Xd rotation(3, mode_count);
    for (int l = 0; l < mode_count; ++l)
      translation.col(l) = body.shapes[static_cast<std::size_t>(l)].col(point);
    random.fill(rotation);
    body.interfaces.push_back({name, body.nodes_m.col(point), translation, 5.0 * rotation});
  }
  add_second_order(seed + 1000, result);
  return result;
}

}  // namespace flexneck::testing
