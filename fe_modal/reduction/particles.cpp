// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/reduction/particles.h"

#include <cmath>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include "fe_modal/dofs/rigid_mass.h"

namespace flexneck::fe_modal {
namespace {

/// Adds particles for a point mass: pairs on the principal axes have its second moments of mass,
/// one at the centre the remaining mass.
void add_particles(const mesher::PointMass& mass, std::vector<Particle>& particles) {
  const Eigen::Matrix3d inertia = inertia_of(mass);
  const Eigen::Vector3d center(mass.center_m.data());
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> moments(
      inertia.trace() / 2 * Eigen::Matrix3d::Identity() - inertia);
  const double largest = moments.eigenvalues().cwiseAbs().maxCoeff();
  const double square_m2 = mass.mass_kg > 0 && largest > 0 ? largest / mass.mass_kg : 1;
  const auto add = [&](double kg, const Eigen::Vector3d& arm_m) {
    Particle& particle = particles.emplace_back();
    particle.mass_kg = kg;
    particle.site = mass.site;
    particle.arm_m = arm_m;
  };
  double left_kg = mass.mass_kg;
  for (Eigen::Index k = 0; k < 3 && largest > 0; ++k) {
    const double half_kg = moments.eigenvalues()[k] / (2 * square_m2);
    if (half_kg == 0) continue;
    const Eigen::Vector3d offset = std::sqrt(square_m2) * moments.eigenvectors().col(k);
    for (const double sign : {-1.0, 1.0}) {
      add(half_kg, center + sign * offset);
    }
    left_kg -= 2 * half_kg;
  }
  if (left_kg != 0) add(left_kg, center);
}

}  // namespace

std::vector<Particle> particles_of(const mesher::Mesh& mesh, const DofMap& dof_map,
                                   const Eigen::MatrixXd& modes) {
  std::vector<Particle> particles;
  for (const mesher::PointMass& mass : mesh.connections.masses) add_particles(mass, particles);
  const auto nodes = static_cast<std::int32_t>(mesh.nodes.size());
  for (Particle& particle : particles) {
    const bool is_node = particle.site < nodes;
    const auto& x =
        is_node ? mesh.nodes[static_cast<std::size_t>(particle.site)]
                : mesh.connections.points[static_cast<std::size_t>(particle.site - nodes) / 2]
                      .position_m;
    particle.position_m = Eigen::Vector3d(x.data()) + particle.arm_m;
    particle.motions.resize(3, modes.cols());
    for (Eigen::Index k = 0; k < modes.cols(); ++k) {
      particle.motions.col(k) = dof_map.motion_of(particle.site, modes.col(k));
      if (is_node) continue;
      particle.motions.col(k) +=
          dof_map.motion_of(particle.site + 1, modes.col(k)).cross(particle.arm_m);
    }
  }
  return particles;
}

}  // namespace flexneck::fe_modal
