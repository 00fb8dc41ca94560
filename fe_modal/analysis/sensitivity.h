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

/// Material constants in the order of the columns of BodyGradient::by_material.
enum class MaterialConstant { youngs_modulus, poissons_ratio, density };

/// A constant of one of the mesh's materials.
struct MaterialParameter {
  std::size_t material = 0;  ///< index into Mesh::materials
  MaterialConstant constant = MaterialConstant::youngs_modulus;
};

/// A parameter of the design of a body.
struct DesignParameter {
  std::string name;
  std::string unit;  ///< unit of the value
  double value = 0;
  /// Effect of the parameter: velocities of the nodes, (3, n) in m per unit of it
  /// (mesher/mesh/node_velocity), or a constant of a material.
  std::variant<Eigen::Matrix3Xd, MaterialParameter> change;
};

/// Kind of a differentiated quantity.
enum class QuantityKind {
  frequency,       ///< frequency of a single mode
  mean_frequency,  ///< root mean square of equal or nearly equal frequencies
  directional,     ///< branch of a multiple frequency, along one parameter alone: see Sensitivities
  symmetry_class,  ///< one of several equal frequencies, among the motions of its symmetry
  mass,            ///< mass of the whole body
  static_stiffness,  ///< load over displacement of an interface, under this load alone
};

/// Name of a kind: "frequency", "mean", "directional", "symmetry class", "mass", "static
/// stiffness".
std::string_view name_of(QuantityKind kind);

/// Name of a static stiffness under one of the loads on an interface, force (3), moment (3): "Fx/ux
/// at top".
std::string stiffness_name(std::size_t load, const std::string& interface);

struct Quantity {
  QuantityKind kind = QuantityKind::frequency;
  std::string name;          ///< "torsion 1", "head on top 1", "Fx/ux at top", all of a group
  std::string unit;          ///< "Hz", "kg", "N/m" or "N m/rad"
  double value = 0;          ///< in the unit above
  bool is_attached = false;  ///< true for a frequency with a body attached
};

/// Derivatives of q quantities by p parameters.
///
/// Modes whose frequencies lie closer than kNearlyEqual to their neighbours' are a group. The shape
/// of a single one is arbitrary: a small change of the body rotates it among the others. Defined
/// are
///  - the gradient of the mean of their eigenvalues (the trace), always;
///  - directional derivatives: the eigenvalues, in ascending order, of Phi^T (dK - lambda dM) Phi
///    for a change of one parameter, numbered (1), (2), …: each belongs to a mixture of the modes.
///    They are no gradient: those of several parameters do not add. For modes that are only nearly
///    equal they are the values for exactly equal modes;
///  - the gradient of each mode by itself if no parameter couples it to another of the group
///    (kUncoupled), as when the modes have different symmetries that all parameters keep.
struct Sensitivities {
  std::vector<Quantity> quantities;
  std::vector<DesignParameter> parameters;  ///< requested parameters, without the nodes' velocities
  Eigen::MatrixXd derivatives;              ///< (q, p), in the quantity's unit over the parameter's
  /// A line for each group, and for each quantity without derivatives.
  std::vector<std::string> notes;

  /// d ln quantity / d ln parameter, (q, p); 0 where the parameter is 0.
  Eigen::MatrixXd relative() const;
};

/// Relative difference of neighbouring frequencies below which modes are a group.
inline constexpr double kNearlyEqual = 0.01;
/// Value of |Phi_i^T (dK - lambda dM) Phi_j| times the parameter, over lambda, below which modes
/// count as uncoupled: the loss of symmetry of a mesh when a mesher works to nine digits.
inline constexpr double kUncoupled = 1e-6;

/// Derivatives of all elastic frequencies, alone and with bodies attached, of the mass, and of a
/// fixed body's static stiffness at its interfaces. The interfaces' points, the attached bodies and
/// the sets of nodes stay fixed. They are computed from fields of the one solution, by one pass
/// over the elements (EnergyGradient), whatever the number of parameters. The derivative of an
/// eigenvalue is
///
///   d lambda = phi^T (dK - lambda dM) phi,   df = d lambda / (8 pi^2 f),
///
/// with M + C^T M_r C in place of M if a body is attached, and that of the stiffness k = 1 / (C u)
/// under a unit load K u = C^T
///
///   d(C u) = 2 dC u - u^T dK u,   dk = -k^2 d(C u).
///
/// (Fox and Kapoor, AIAA J. 6 (1968) 2426; for equal eigenvalues Seyranian, Lund and Olhoff,
/// Struct. Optim. 8 (1994) 207.)
/// @param body result of analyse_modes() on this mesh with these options
/// @param fields those of the same call
/// @throws InputError for a basis without eigenvectors (Craig-Bampton), and for an interface that
/// shares nodes with a rigid one.
/// @throws ComputationError as ElementKernel.
Sensitivities sensitivities(const mesher::Mesh& mesh, const ModalOptions& options,
                            const ModalBody& body, const AnalysisFields& fields,
                            std::vector<DesignParameter> parameters);

}  // namespace flexneck::fe_modal
