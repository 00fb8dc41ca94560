// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "fe_modal/algebra/ranks.h"
#include "fe_modal/body/basis_kind.h"
#include "fe_modal/dofs/rigid_motions.h"
#include "fe_modal/element/formulation.h"
#include "fe_modal/system/loads.h"
#include "fe_modal/system/solver.h"
#include "mesher/mesh/mesh.h"

namespace flexneck::fe_modal {

/// An interface: its motion is the least-squares rigid motion of a face set about a point, which
/// minimises int |u - t - theta x (x - position)|^2 dA. It is zero on a fixed face set or node set.
struct InterfaceDefinition {
  std::string name;
  std::string set;  ///< a face set; for the fixed interface a node set
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
  /// True if its nodes are tied to one another and move rigidly, as if glued to a stiff plate.
  bool is_rigid = false;
};

/// A rigid body fixed to an interface, for the frequencies of the loaded structure.
struct RigidAttachment {
  std::string name;
  std::string interface;
  double mass_kg = 0;
  Eigen::Vector3d center_m = Eigen::Vector3d::Zero();       ///< mesh frame
  Eigen::Matrix3d inertia_kg_m2 = Eigen::Matrix3d::Zero();  ///< about the centre, mesh axes
};

struct ModalOptions {
  int mode_count = 10;
  FormulationChoice formulation;
  Solver solver = Solver::automatic;
  /// Options of PETSc and SLEPc, such as "-eps_ncv 40": they affect the method of solution, not the
  /// problem (petsc_choices.h).
  std::string petsc_options = {};
  BasisKind basis = BasisKind::normal;
  /// Interfaces whose static shapes join the basis; all if empty.
  std::vector<std::string> basis_interfaces;
  /// Treatment of slits; with the modes of the body with slits shut.
  SlitMotions slit_motions = SlitMotions::none;
  bool geometric_stiffness = false;  ///< compute that of the modes of a fixed body under unit loads
  /// Count the modes by a Sturm count too, which costs a factorisation, and estimate the
  /// discretisation error, which costs some ten times the modes. Not available for Craig-Bampton.
  bool check = false;
  std::string fixed_set;  ///< node set fixed in all directions; none if empty
  /// Node sets fixed in some of x, y and z only.
  std::map<std::string, std::array<bool, 3>> fixed_directions = {};
  std::string fixed_interface;  ///< name of the interface on the fixed nodes, modes zero there
  Eigen::Vector3d fixed_position_m = Eigen::Vector3d::Zero();
  std::vector<InterfaceDefinition> interfaces;
  std::vector<std::string> rigid_parts;  ///< parts whose rigid motions name the modes: the plates
  double length_m = 0;                   ///< scales rotations to lengths for the sign rule
  std::string sign_interface;            ///< interface whose motion fixes the signs
  std::vector<RigidAttachment> attachments;
  /// Loads of a linear static step whose stresses the modes are about; none if empty.
  std::vector<Load> prestress = {};
  /// Displacements of that step, (3, n), set by add_prestress(); no columns without prestress.
  Eigen::Matrix3Xd prestress_m = Eigen::Matrix3Xd();
  Ranks ranks = {};  ///< processes that share the work
  /// Rank of each element, from the mesh; by METIS if empty.
  std::vector<std::int32_t> element_ranks = {};
  /// (n) order of elimination from the mesh; by METIS if empty. MUMPS has its own.
  std::vector<std::int32_t> node_order = {};
};

/// Connections of the mesh, followed by rigid interfaces and sets fixed in some directions.
/// @throws InputError for unknown sets.
mesher::Connections connections_of(const mesher::Mesh& mesh, const ModalOptions& options);

/// Degrees of freedom of a mesh under the supports of the options.
/// @throws InputError for unknown sets, as DofMap, and for a rigid interface that does not move.
DofMap dof_map_of(const mesher::Mesh& mesh, const ModalOptions& options);

/// Rigid motions of the body as a whole under the supports of the options.
RigidMotions rigid_motions_of(const mesher::Mesh& mesh, const ModalOptions& options);

/// Text of the supports: "fixed: bolts, x of left; slides along y", or "free".
std::string boundary_of(const mesher::Mesh& mesh, const ModalOptions& options,
                        const RigidMotions& rigid);

}  // namespace flexneck::fe_modal
