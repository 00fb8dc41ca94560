// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "fe_modal/dofs/constrained_element.h"
#include "fe_modal/dofs/dof_map.h"
#include "fe_modal/element/formulation.h"
#include "fe_modal/system/nodal_rows.h"
#include "mesher/mesh/mesh.h"

namespace flexneck::fe_modal {

/// K and M of a mesh element by element, for meshes whose assembled stiffness would take too much
/// memory.
class ElementOperator {
 public:
  /// As assemble() takes them; mesh and dof_map must outlive this.
  ElementOperator(const mesher::Mesh& mesh, const DofMap& dof_map,
                  const FormulationChoice& formulation, Eigen::Matrix3Xd prestress_m);

  struct Products {
    Eigen::MatrixXd forces;   ///< K X
    Eigen::MatrixXd momenta;  ///< M X
  };
  /// @param columns (dofs, k)
  /// @throws what assemble() throws.
  Products apply(const Eigen::MatrixXd& columns) const { return multiply(columns, true); }
  /// K X alone.
  Eigen::MatrixXd forces(const Eigen::MatrixXd& columns) const {
    return multiply(columns, false).forces;
  }

  /// Calls visit(numbers, stiffness) for each element, point masses and springs behind: the blocks
  /// of its places, -1 where there is none, and its stiffness under the constraints, (3m, 3m) with
  /// degree of freedom a m + i, which visit() may change.
  using Visitor =
      std::function<void(std::span<const std::int32_t> numbers, Eigen::MatrixXd& stiffness)>;
  void for_each_stiffness(const Visitor& visit) const;
  /// The numbers alone.
  void for_each_numbers(const std::function<void(std::span<const std::int32_t>)>& visit) const;

 private:
  /// Of a point mass or a spring, under the constraints.
  struct Point {
    ConstrainedElement element;
    Eigen::MatrixXd stiffness;
    Eigen::MatrixXd mass;
  };

  Products multiply(const Eigen::MatrixXd& columns, bool with_mass) const;
  void add_elements(const NodalRows& motions, NodalRows& forces,
                    std::optional<NodalRows>& momenta) const;
  static void add_point(const Point& point, const Eigen::MatrixXd& columns, bool with_mass,
                        Products& products);

  const mesher::Mesh& mesh_;
  const DofMap& dof_map_;
  FormulationChoice formulation_;
  Eigen::Matrix3Xd prestress_m_;
  std::vector<Point> points_;
};

}  // namespace flexneck::fe_modal
