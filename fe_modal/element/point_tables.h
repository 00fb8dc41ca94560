// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <variant>
#include <vector>

#include <Eigen/Core>

#include "fe_modal/algebra/packed_matrix.h"
#include "fe_modal/algebra/register_row.h"
#include "fe_modal/algebra/symmetric_sum.h"
#include "mesher/mesh/shape_functions.h"

namespace flexneck::fe_modal {

/// What takes fields of a 27-node hexahedron to 3 x 3 x 3 points and back: one direction after the
/// other, with the three functions of a line, in less than a third of the operations.
class LineTables {
 public:
  /// @param positions of the three points of a line
  LineTables(const std::array<double, 3>& positions, VectorRegisters registers);

  // As in PointTables.
  void to_gradients(const RowOf<double>* x, std::size_t groups, RowOf<double>* y) const;
  void from_gradients(const RowOf<double>* x, std::size_t groups, RowOf<double>* y) const;
  void to_values(const RowOf<double>* x, std::size_t groups, RowOf<double>* y) const;
  void multiply_by_mass(const Eigen::VectorXd& masses_kg, const RowOf<double>* x,
                        std::size_t groups, RowOf<double>* y) const;

 private:
  /// Of the three functions at the three points of a line, point by point, or transposed.
  using Table = std::array<double, 9>;

  VectorRegisters registers_;
  std::array<std::size_t, 27> place_of_node_;  ///< 9 i + 3 j + k of the node's coordinates
  Table values_;
  Table derivatives_;
  Table values_transposed_;
  Table derivatives_transposed_;
};

/// The same of any kind and rule, by tables of all nodes and points.
class FullTables {
 public:
  FullTables(const mesher::ShapeTable& table, VectorRegisters registers);

  // As in PointTables.
  void to_gradients(const RowOf<double>* x, std::size_t groups, RowOf<double>* y) const {
    gradients_.multiply(x, groups, y, registers_);
  }
  void from_gradients(const RowOf<double>* x, std::size_t groups, RowOf<double>* y) const {
    gradients_transposed_.multiply(x, groups, y, registers_);
  }
  void to_values(const RowOf<double>* x, std::size_t groups, RowOf<double>* y) const {
    values_.multiply(x, groups, y, registers_);
  }
  void multiply_by_mass(const Eigen::VectorXd& masses_kg, const RowOf<double>* x,
                        std::size_t groups, RowOf<double>* y);

 private:
  VectorRegisters registers_;
  PackedMatrix gradients_;
  PackedMatrix gradients_transposed_;
  PackedMatrix values_;
  SymmetricSum mass_;  ///< of N N^T of each point
};

/// Shape functions of an element with n nodes at the q points of a rule, times fields: rows of
/// eight columns, some groups for each node or point.
class PointTables {
 public:
  PointTables(mesher::ElementKind kind, const mesher::Quadrature& rule, VectorRegisters registers);

  /// @param x (n, groups)
  /// @param y (3q, groups), row 3 p + b: d/dxi_b at point p
  void to_gradients(const RowOf<double>* x, std::size_t groups, RowOf<double>* y) const {
    std::visit([&](const auto& tables) { tables.to_gradients(x, groups, y); }, tables_);
  }
  /// The transpose of that.
  void from_gradients(const RowOf<double>* x, std::size_t groups, RowOf<double>* y) const {
    std::visit([&](const auto& tables) { tables.from_gradients(x, groups, y); }, tables_);
  }
  /// @param x (n, groups)
  /// @param y (q, groups)
  void to_values(const RowOf<double>* x, std::size_t groups, RowOf<double>* y) const {
    std::visit([&](const auto& tables) { tables.to_values(x, groups, y); }, tables_);
  }
  /// The mass matrix of an element times x.
  /// @param masses_kg (q), that each point stands for
  /// @param x, y (n, groups)
  void multiply_by_mass(const Eigen::VectorXd& masses_kg, const RowOf<double>* x,
                        std::size_t groups, RowOf<double>* y) {
    std::visit([&](auto& tables) { tables.multiply_by_mass(masses_kg, x, groups, y); }, tables_);
  }

 private:
  std::variant<FullTables, LineTables> tables_;
};

}  // namespace flexneck::fe_modal
