// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <Eigen/Core>

#include "fe_modal/analysis/modal_analysis.h"
#include "fe_modal/body/modal_body.h"
#include "fe_modal/system/modal_options.h"
#include "mesher/mesh/mesh.h"

namespace flexneck::fe_modal {

/// In the order of the columns of BodyGradient::by_material.
enum class MaterialConstant { youngs_modulus, poissons_ratio, density };

/// A constant of one of the mesh's materials.
struct MaterialParameter {
  std::size_t material = 0;  ///< index into Mesh::materials
  MaterialConstant constant = MaterialConstant::youngs_modulus;
};

/// A number that a body is made from.
struct DesignParameter {
  std::string name;
  std::string unit;  ///< of the value
  double value = 0;
  /// What it changes: the nodes' positions, (3, n) in m per unit of it (mesher/mesh/node_velocity),
  /// or a material.
  std::variant<Eigen::Matrix3Xd, MaterialParameter> change;
};

/// What is differentiated.
enum class QuantityKind {
  frequency,         ///< of a single mode
  mean_frequency,    ///< of equal or nearly equal ones: root of the mean of their squares
  directional,       ///< of one branch of them, along one parameter alone: see Sensitivities
  symmetry_class,    ///< of one of them among the motions of its symmetry
  mass,              ///< of the whole body
  static_stiffness,  ///< load by motion of an interface, under this load alone
};

/// "frequency", "mean", "directional", "symmetry class", "mass", "static stiffness".
std::string_view name_of(QuantityKind kind);

/// "Fx/ux at top": static stiffness under one of the loads on an interface, force (3), moment (3).
std::string stiffness_name(std::size_t load, const std::string& interface);

struct Quantity {
  QuantityKind kind = QuantityKind::frequency;
  std::string name;          ///< "torsion 1", "head on top 1", "Fx/ux at top", all of a group
  std::string unit;          ///< "Hz", "kg", "N/m" or "N m/rad"
  double value = 0;          ///< in that unit
  bool is_attached = false;  ///< a frequency with a body attached
};

/// Derivatives of q quantities by p parameters.
///
/// Modes whose frequencies lie closer than kNearlyEqual to their neighbours' are a group. A shape
/// of it means little: a small change of the body turns it among the others. What exists is
///  - the gradient of the mean of their eigenvalues (the trace), always;
///  - directional derivatives: the eigenvalues, in ascending order, of Phi^T (dK - lambda dM) Phi
///    for a change of one parameter, numbered (1), (2), …: each belongs to a mixture of the modes.
///    They are no gradient: of a change of several parameters they do not add. Of modes that are
///    only nearly equal they are what they would be if they were equal;
///  - the gradient of each mode by itself where no parameter couples it to another of the group
///    (kUncoupled), as when the modes have different symmetries that all parameters keep.
struct Sensitivities {
  std::vector<Quantity> quantities;
  std::vector<DesignParameter> parameters;  ///< those asked for, without the nodes' velocities
  Eigen::MatrixXd derivatives;              ///< (q, p), the quantity's unit by the parameter's
  /// A line for each group, and for what there are no derivatives of.
  std::vector<std::string> notes;

  /// d ln quantity / d ln parameter, (q, p); 0 where the parameter is 0.
  Eigen::MatrixXd relative() const;
};

/// Relative difference of neighbouring frequencies below which modes are a group.
inline constexpr double kNearlyEqual = 0.01;
/// |Phi_i^T (dK - lambda dM) Phi_j| times the parameter, over lambda, below which modes count as
/// uncoupled: what a mesh keeps of its symmetry when a mesher works to nine digits.
inline constexpr double kUncoupled = 1e-6;

/// Derivatives of all elastic frequencies, alone and with bodies attached, of the mass, and of a
/// fixed body's static stiffness at its interfaces. The interfaces' points and the attached bodies
/// stay where they are, and so do the sets of nodes. From fields of the one solution, by one pass
/// over the elements (EnergyGradient), whatever the number of parameters. Of an eigenvalue,
///
///   d lambda = phi^T (dK - lambda dM) phi,   df = d lambda / (8 pi^2 f),
///
/// with a body attached M + C^T M_r C in place of M; of the stiffness k = 1 / (C u) under a unit
/// load K u = C^T
///
///   d(C u) = 2 dC u - u^T dK u,   dk = -k^2 d(C u).
///
/// (Fox and Kapoor, AIAA J. 6 (1968) 2426; of equal eigenvalues Seyranian, Lund and Olhoff, Struct.
/// Optim. 8 (1994) 207.)
/// @param body of analyse_modes() on this mesh with these options
/// @param fields of the same call
/// @throws InputError for a basis without eigenvectors (Craig-Bampton), and for an interface that
/// shares nodes with a rigid one.
/// @throws ComputationError as ElementKernel.
Sensitivities sensitivities(const mesher::Mesh& mesh, const ModalOptions& options,
                            const ModalBody& body, const AnalysisFields& fields,
                            std::vector<DesignParameter> parameters);

}  // namespace flexneck::fe_modal
