// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "fe_modal/dofs/rigid_motions.h"
#include "fe_modal/system/field_map.h"
#include "fe_modal/system/modal_options.h"
#include "mesher/mesh/mesh.h"

namespace flexneck::fe_modal {

/// A mesh with its options and the data that they determine, computed once for all analyses of it:
/// connections, degrees of freedom, the remaining rigid motions, and the share of each rank. Blocks
/// of degrees of freedom are numbered as the rows of matrices: in a serial run in the order of
/// their elimination, otherwise those of the first rank first.
class Model {
 public:
  /// @param mesh must outlive this; the same on all ranks
  /// @throws InputError as check_options(), and for a rank without an element.
  Model(const mesher::Mesh& mesh, ModalOptions options);
  Model(const Model&) = delete;
  Model& operator=(const Model&) = delete;

  const mesher::Mesh& mesh() const { return mesh_; }
  const ModalOptions& options() const { return options_; }
  const mesher::Connections& connections() const { return connections_; }
  const DofMap& dof_map() const { return dof_map_; }
  const RigidMotions& rigid() const { return rigid_; }
  const FieldMap& fields() const { return fields_; }
  const Ranks& ranks() const { return options_.ranks; }
  /// Rank of each element, spring and mass, in the order of for_each_element(); empty in a serial
  /// run.
  const std::vector<std::int32_t>& rank_of_element() const { return rank_of_element_; }
  /// Text of the supports: "fixed: bolts, x of left; slides along y", or "free".
  std::string boundary() const { return boundary_of(mesh_, options_, rigid_); }

  /// Adds the geometric stiffness of displacements of all nodes, (3, n), to matrices assembled
  /// after this call.
  void set_prestress(const Eigen::Matrix3Xd& displacements_m) {
    options_.prestress_m = displacements_m;
  }

 private:
  FieldMap numbered();
  DofLayout shared_out();

  const mesher::Mesh& mesh_;
  ModalOptions options_;
  mesher::Connections connections_;
  DofMap dof_map_;
  RigidMotions rigid_;
  std::vector<std::int32_t> rank_of_element_;
  FieldMap fields_;
};

}  // namespace flexneck::fe_modal
