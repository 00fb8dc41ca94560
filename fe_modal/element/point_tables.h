// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include <Eigen/Core>

#include "fe_modal/algebra/packed_matrix.h"
#include "fe_modal/algebra/register_row.h"
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
  void from_values(const RowOf<double>* x, std::size_t groups, RowOf<double>* y) const;

 private:
  /// Of the three functions at the three points of a line, point by point, or transposed.
  using Table = std::array<double, 9>;

  /// The same table in all three directions.
  void multiply(const Table& table, bool to_points, const RowOf<double>* x, std::size_t groups,
                RowOf<double>* y) const;

  VectorRegisters registers_;
  std::array<std::size_t, 27> place_of_node_;  ///< 9 i + 3 j + k of the node's coordinates
  Table values_;
  Table derivatives_;
  Table values_transposed_;
  Table derivatives_transposed_;
};

/// Shape functions of an element with n nodes at the q points of a rule, times fields: rows of
/// eight columns, some groups for each node or point.
class PointTables {
 public:
  PointTables(mesher::ElementKind kind, const mesher::Quadrature& rule, VectorRegisters registers);

  std::size_t node_count() const { return values_.columns(); }
  std::size_t point_count() const { return values_.rows(); }

  /// @param x (n, groups)
  /// @param y (3q, groups), row 3 p + b: d/dxi_b at point p
  void to_gradients(const RowOf<double>* x, std::size_t groups, RowOf<double>* y) const;
  /// The transpose of that.
  void from_gradients(const RowOf<double>* x, std::size_t groups, RowOf<double>* y) const;
  /// @param x (n, groups)
  /// @param y (q, groups)
  void to_values(const RowOf<double>* x, std::size_t groups, RowOf<double>* y) const;
  /// The transpose of that.
  void from_values(const RowOf<double>* x, std::size_t groups, RowOf<double>* y) const;

 private:
  PointTables(const mesher::ShapeTable& table, mesher::ElementKind kind,
              const mesher::Quadrature& rule, VectorRegisters registers);

  VectorRegisters registers_;
  std::optional<LineTables> lines_;
  PackedMatrix gradients_;
  PackedMatrix gradients_transposed_;
  PackedMatrix values_;
  PackedMatrix values_transposed_;
};

}  // namespace flexneck::fe_modal
