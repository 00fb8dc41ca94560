// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "fe_modal/algebra/register_row.h"
#include "fe_modal/element/formulation.h"
#include "fe_modal/element/moduli.h"
#include "fe_modal/element/point_tables.h"
#include "mesher/mesh/mesh.h"
#include "mesher/mesh/shape_functions.h"

namespace flexneck::fe_modal {

/// Stiffness and mass of one element, those of ElementKernel, times fields of displacement, without
/// forming the matrices. Holds its workspace: one a thread.
///
/// Fields are rows of eight columns: (n, groups_of(k)) of them, a row for each node; column a k + c
/// is direction a of field c.
class ElementProduct {
 public:
  explicit ElementProduct(const ElementScheme& scheme,
                          VectorRegisters registers = widest_registers());

  /// Groups of eight columns that k fields take.
  static std::size_t groups_of(std::size_t fields) {
    return (3 * fields + kColumnsTogether - 1) / kColumnsTogether;
  }

  /// @param nodes_m (3, n) positions of the nodes
  /// @param fields of which the columns behind the first 3k should be zero
  /// @param forces, momenta as the fields; momenta perhaps null
  /// @throws ComputationError if the element is inverted at an integration point.
  void apply(const Eigen::Matrix3Xd& nodes_m, const mesher::Material& material,
             const RowOf<double>* fields, std::size_t field_count, RowOf<double>* forces,
             RowOf<double>* momenta);

 private:
  /// The points of a rule, what takes fields there and back, and where the points of the element
  /// are.
  struct Rule {
    Rule(mesher::ElementKind kind, int strength, VectorRegisters registers);
    std::size_t point_count() const { return static_cast<std::size_t>(roots.size()); }

    mesher::Quadrature quadrature;
    PointTables tables;
    Eigen::VectorXd roots;         ///< (q), root of the volume that a point stands for
    Eigen::Matrix3Xd to_physical;  ///< (3, 3q), of each point dxi_a / dx_b times its root
  };

  void take_positions(const Eigen::Matrix3Xd& nodes_m);
  /// Finds the roots of a rule and calls visit(point, Jacobian) for each.
  /// @throws ComputationError if the element is inverted at a point.
  template <typename Visitor>
  void find_roots(Rule& rule, const Visitor& visit);
  /// Finds the roots of a rule and what makes its gradients physical.
  void map(Rule& rule);
  void find_element_pressures();
  /// Gradients at the points become stresses, both times the points' roots: row 3 p + b, column
  /// a k + c is du_a / dx_b of field c, then sigma_ab.
  void turn_to_stress(const Moduli& moduli, std::size_t field_count);

  ElementScheme scheme_;
  VectorRegisters registers_;
  Rule rule_;                      ///< of the stiffness
  std::optional<Rule> mass_rule_;  ///< of the mass, where it is another
  Eigen::MatrixXd pressures_;      ///< (q, p), of find_pressures()
  // Workspace:
  std::vector<RowOf<double>> positions_;  ///< (n), of take_positions(): a node in each
  std::vector<RowOf<double>> at_points_;
  Eigen::MatrixX3d point_positions_;  ///< (q, 3)
  Eigen::MatrixXd volumetric_;        ///< (k, q)
  Eigen::MatrixXd coefficients_;      ///< (k, p), of the pressures
  Eigen::VectorXd masses_kg_;         ///< that the points of the mass stand for
};

}  // namespace flexneck::fe_modal
