// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "fe_modal/solve/refined/inner_block.h"
#include "fe_modal/solve/refined/panel_factor.h"
#include "fe_modal/solve/refined/star_lists.h"
#include "fe_modal/system/element_operator.h"

namespace flexneck::fe_modal {

/// Exact solves on the star of each corner of the elements: the blocks of the nodes within all
/// edges, faces and elements that end there, the corner among them. In a nearly incompressible body
/// a node alone cannot move without change of volume; a star can (Schoeberl, Numer. Math. 84 (1999)
/// 97; Arnold, Falk and Winther, ibid. 85 (2000) 197).
class StarPatches {
 public:
  /// @param stiffness of the mesh, whose elements' matrices are summed up
  /// @throws ComputationError if the stiffness is not positive definite.
  StarPatches(const StarMesh& body, const ElementOperator& stiffness);

  /// Adds the solutions of all stars for each column, times a weight.
  /// @param residuals, sums (dofs, k)
  void add_stars(double weight, const Eigen::MatrixXd& residuals, Eigen::MatrixXd& sums) const {
    add_solutions(all_, weight, residuals, sums);
  }
  /// The same of the stars of find_cells(): these do not meet, and together they are exact.
  void add_cells(double weight, const Eigen::MatrixXd& residuals, Eigen::MatrixXd& sums) const {
    add_solutions(cells_, weight, residuals, sums);
  }

 private:
  struct Patch {
    std::vector<std::int32_t> blocks;  ///< ascending, without those of inner_
    PanelFactor factor;
  };
  struct Selection {
    std::vector<std::size_t> patches;
    std::vector<std::size_t> stars_of_inner;  ///< those of the patches that have an inner block
  };

  /// Takes inner blocks out of the stars, and counts for both selections those that had them.
  /// These blocks and their columns are allocated, so that what comes and goes while elements are
  /// summed up leaves no gaps between them.
  /// @return the place in each element, -1: none
  std::vector<std::int32_t> take_inner(const ElementOperator& elements, std::size_t block_count,
                                       PatchLists& stars);
  void add_solutions(const Selection& selection, double weight, const Eigen::MatrixXd& residuals,
                     Eigen::MatrixXd& sums) const;
  /// So many columns at a time.
  template <std::size_t lanes>
  void add_by_lanes(const Selection& selection, double weight, const Eigen::MatrixXd& residuals,
                    Eigen::MatrixXd& sums) const;
  template <std::size_t lanes>
  struct Workspace {
    std::vector<RowOf<float, lanes>> rows;
    std::vector<float> factor;
  };
  /// @param forces, sums (dofs x groups), row by row
  template <std::size_t lanes>
  static void add_solution(const Patch& patch, std::size_t groups,
                           std::span<const RowOf<float, lanes>> forces,
                           std::span<RowOf<float, lanes>> sums, Workspace<lanes>& workspace);

  std::vector<InnerBlock> inner_;  ///< of elements, in their order
  std::vector<Patch> patches_;
  Selection all_;
  Selection cells_;  ///< those of add_cells()
};

}  // namespace flexneck::fe_modal
