// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include <Eigen/Core>

#include "fe_modal/element/formulation.h"
#include "fe_modal/element/moduli.h"
#include "mesher/mesh/mesh.h"

namespace flexneck::fe_modal {

/// Matrices of one element with n nodes. Degree of freedom a n + i is direction a of node i.
struct ElementMatrices {
  Eigen::MatrixXd stiffness;  ///< (3n, 3n), N/m, symmetric
  Eigen::MatrixXd mass;       ///< (n, n), consistent, kg, the same in each direction
};

/// Fields of displacement at the q points of an element's stiffness.
struct PointFields {
  Eigen::VectorXd volumes_m3;  ///< (q), volume of each point
  /// Entry 3 a + b, (k, q): du_a / dx_b of each of k fields.
  std::array<Eigen::MatrixXd, 9> gradients;
  Eigen::MatrixXd dilatation;            ///< (k, q): div u
  Eigen::MatrixXd projected_dilatation;  ///< (k, q): p(div u); div u itself without pressures
  Eigen::MatrixXd volumetric_Pa;         ///< (k, q): stress is mu (grad + grad^T) + volumetric I
};

/// An element with n nodes at the q points of a rule.
struct ElementPoints {
  Eigen::VectorXd volumes_m3;    ///< (q), volume of each point
  Eigen::Matrix3Xd positions_m;  ///< (3, q)
  Eigen::MatrixXd values;        ///< (n, q), shape functions
  Eigen::MatrixXd gradients;     ///< (3n, q), row a n + i: dN_i / dx_a, 1/m
};

/// Stiffness and consistent mass of an element of any kind, linear isotropic elasticity; kinds
/// differ only in their tables. In the mixed formulation the dilatation is projected (L2) to the
/// element's pressures, so that the stiffness stays symmetric and positive. This formulation serves
/// every material: on the 26k-DOF neck of 27-node hexahedra the first bending frequency is 0.02 %
/// nearer to the converged one with it in the aluminium plates as well.
///
/// All integrals of products are matrix products over the points, done by the BLAS: for a 27-node
/// element 0.4 of 0.5 million operations. Each kernel has its own workspace: use one per thread.
class ElementKernel {
 public:
  explicit ElementKernel(const ElementScheme& scheme);

  /// @param nodes_m (3, n) positions of the nodes
  /// @throws ComputationError if the element is inverted at an integration point.
  void compute(const Eigen::Matrix3Xd& nodes_m, const mesher::Material& material,
               ElementMatrices& result);
  /// Computes the stiffness alone, as in ElementMatrices.
  void find_stiffness(const Eigen::Matrix3Xd& nodes_m, const mesher::Material& material,
                      Eigen::MatrixXd& result);

  /// Computes the gradients and stresses at the points of the stiffness.
  /// @param fields (3n, k), degree of freedom a n + i is direction a of node i
  void evaluate(const Eigen::Matrix3Xd& nodes_m, const mesher::Material& material,
                const Eigen::MatrixXd& fields, PointFields& result);

  /// Finds the points at which compute() integrates stiffness and mass.
  /// @throws ComputationError if the element is inverted at one of them.
  void locate(const Eigen::Matrix3Xd& nodes_m, ElementPoints& of_stiffness, ElementPoints& of_mass);

 private:
  /// Shape functions at the points of a rule.
  struct Points {
    Points(mesher::ElementKind kind, int strength);

    Eigen::MatrixXd derivatives;  ///< (n, 3q), point by point d/dxi, d/deta, d/dzeta
    Eigen::MatrixXd values;       ///< (n, q)
    Eigen::Matrix3Xd reference;   ///< (3, q)
    Eigen::VectorXd weights;      ///< (q)
    Eigen::Matrix3Xd jacobians;   ///< workspace: (3, 3q), dx_a / dxi_b
    Eigen::VectorXd roots;        ///< workspace: (q), square root of each point's volume
  };

  static void map(const Eigen::Matrix3Xd& nodes_m, Points& points);
  static void find_roots(Points& points);
  /// Computes dN_i / dx_a at the points, times the square roots of their volumes.
  /// @param visit called with each point's number and (n, 3) gradients
  template <typename Visitor>
  static void differentiate(const Points& points, const Visitor& visit);
  void find_gradients();
  static void locate(const Eigen::Matrix3Xd& nodes_m, Points& points, ElementPoints& result);
  void project_divergence(const Eigen::Matrix3Xd& nodes_m);
  void add_displacement_part(double mu, double square, Eigen::MatrixXd& stiffness) const;

  ElementScheme scheme_;
  Points points_;       ///< points of the stiffness
  Points mass_points_;  ///< points of the mass
  /// Row a n + i, column q: dN_i / dx_a at point q, times the square root of its volume: integrals
  /// of products are products of matrices.
  Eigen::MatrixXd gradients_;
  Eigen::MatrixXd pressures_;   ///< (q, p) basis of the pressures, times the roots, orthonormal
  Eigen::MatrixX3d positions_;  ///< workspace: (q, 3), positions of the points
  Eigen::MatrixXd divergence_;  ///< (3n, p) divergence of the shape functions, projected
  Eigen::MatrixXd products_;    ///< (3n, 3n) int dN_i/dx_a dN_j/dx_b
  Eigen::MatrixXd weighted_;    ///< (n, q) shape functions times the roots
};

}  // namespace flexneck::fe_modal
