// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "fe_modal/dofs/dof_map.h"
#include "fe_modal/solve/refined/panel_factor.h"
#include "fe_modal/system/element_operator.h"
#include "mesher/mesh/mesh.h"

namespace flexneck::fe_modal {

/// What the patches of a refined mesh are made of.
struct StarMesh {
  const mesher::Mesh& mesh;
  const DofMap& dof_map;
  /// (elements) what each was cut from; its elements follow one another.
  std::vector<std::int32_t> parents;
  /// (nodes) whose stars are wanted; empty: all.
  std::vector<bool> is_center;
};

/// Exact solves on the star of each corner of the elements: the blocks of the nodes within all
/// edges, faces and elements that end there, the corner among them. In a nearly incompressible body
/// a node alone cannot move without change of volume; a star can (Schoeberl, Numer. Math. 84 (1999)
/// 97; Arnold, Falk and Winther, ibid. 85 (2000) 197).
class StarPatches {
 public:
  /// @param stiffness of the mesh, whose elements' matrices are summed up
  /// @throws ComputationError if the stiffness is not positive definite.
  StarPatches(const StarMesh& body, const ElementOperator& stiffness);

  /// The sum of the solutions of all stars for each column, (dofs, k).
  Eigen::MatrixXd smooth(const Eigen::MatrixXd& residuals) const;
  /// The same of one star at most within each element of the mesh before, that of its middle where
  /// it has one: these do not meet, and together they are exact.
  Eigen::MatrixXd solve_cells(const Eigen::MatrixXd& residuals) const;

 private:
  struct Patch {
    std::vector<std::int32_t> blocks;  ///< ascending
    PanelFactor factor;
  };

  Eigen::MatrixXd sum_of(const std::vector<std::size_t>& patches,
                         const Eigen::MatrixXd& residuals) const;
  /// So many columns at a time.
  template <std::size_t lanes>
  Eigen::MatrixXd sum_by_lanes(const std::vector<std::size_t>& patches,
                               const Eigen::MatrixXd& residuals) const;
  /// @param forces, sums (dofs x groups), row by row
  template <std::size_t lanes>
  static void add_solution(const Patch& patch, std::size_t groups,
                           std::span<const RowOf<float, lanes>> forces,
                           std::span<RowOf<float, lanes>> sums);

  std::vector<Patch> patches_;
  std::vector<std::size_t> all_;    ///< 0 … patches - 1
  std::vector<std::size_t> cells_;  ///< those of solve_cells()
};

}  // namespace flexneck::fe_modal
