// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace flexneck::fe_modal {

/// Inertia invariants of a body with m modes: integrals over the undeformed volume (equations.md
/// section 2, after Yoo and Haug). s0 is the position in the body frame, psi the (3, m) mode
/// shapes, ~ the skew matrix. SI units; modes are mass-normalised, so a modal coordinate has the
/// unit kg^(1/2) m and a shape kg^(-1/2).
struct InertiaInvariants {
  double mass = 0;                  ///< m = int rho, kg
  Eigen::Vector3d S1;               ///< int rho s0, kg m
  Eigen::Matrix3Xd S2;              ///< int rho psi, (3, m)
  Eigen::Matrix3d J0;               ///< -int rho ~s0 ~s0, kg m^2
  std::vector<Eigen::Matrix3d> G0;  ///< G0[l] = -int rho ~s0 ~psi_l, m of them
  std::vector<Eigen::Matrix3d> G;   ///< G[j * m + l] = -int rho ~psi_j ~psi_l, m * m of them
  Eigen::Matrix3Xd N0;              ///< int rho ~s0 psi, (3, m)
  std::vector<Eigen::Vector3d> N;   ///< N[j * m + l] = int rho ~psi_j psi_l, m * m of them
  Eigen::MatrixXd Maa;              ///< int rho psi^T psi, (m, m): the identity
};

/// Response of an interface to unit loads on it, force (3) and moment (3), from the finite element
/// model: C X and X^T M X of the static shapes K X = C^T, with C the average motion of the
/// interface, translation (3) and rotation (3). For a free body: response to loads that inertia
/// forces balance.
struct StaticResponse {
  Eigen::Matrix<double, 6, 6> compliance;  ///< m/N, 1/N; 1/N, 1/(N m)
  Eigen::Matrix<double, 6, 6> mass;        ///< kg m^2/N^2, kg m/N^2; kg m/N^2, kg/N^2
};

/// An interface where other bodies attach: a rigid frame that moves with the modes.
struct Interface {
  std::string name;
  Eigen::Vector3d position_m;                             ///< undeformed position, body frame
  Eigen::Matrix3Xd translation;                           ///< psi at the interface, (3, m)
  Eigen::Matrix3Xd rotation;                              ///< mu at the interface, (3, m)
  std::optional<StaticResponse> response = std::nullopt;  ///< none if its nodes are fixed
};

/// One motion of the two sides of a slit relative to each other. The jump between them, in any
/// motion of the body, is the sum over these motions of a fixed field times an amplitude; the field
/// is 1 where it is largest.
struct SlitMotion {
  std::string name;
  bool opens = true;  ///< true for an opening, which is not below zero; else the sides slide freely
  Eigen::RowVectorXd amplitude = {};  ///< that of each mode, (m), kg^(-1/2)
};

/// Geometric stiffness of the modes, int grad(psi_i)^T sigma grad(psi_j), (m, m) each, for the
/// stresses sigma of static unit loads. Their sum with the loads' present values is added to the
/// modes' own stiffness: a tensile stress stiffens. Body axes.
struct GeometricStiffness {
  struct OfInterface {
    std::string name;
    std::vector<Eigen::MatrixXd> force;   ///< along x, y, z, 1/(kg m)
    std::vector<Eigen::MatrixXd> moment;  ///< about x, y, z, 1/(kg m^2)
  };
  /// Accelerations of the frame's origin, less gravity, along x, y, z: loads -rho e, 1/m.
  std::vector<Eigen::MatrixXd> acceleration;
  /// Angular accelerations about x, y, z: loads -rho e x s0.
  std::vector<Eigen::MatrixXd> angular_acceleration;
  /// Velocity products w_x^2, w_y^2, w_z^2, w_x w_y, w_x w_z, w_y w_z: loads -rho w x (w x s0).
  std::vector<Eigen::MatrixXd> velocity_products;
  /// Accelerations of the m modal coordinates: loads -rho psi_k, kg^-0.5 m^-1.
  std::vector<Eigen::MatrixXd> modal_acceleration;
  std::vector<OfInterface> interfaces;
};

/// Discretisation error of a mode's frequency, estimated by halving the size of the elements.
struct MeshError {
  double refined_Hz = 0;  ///< frequency of the same shape with each element cut in eight
  double mac = 0;         ///< modal assurance criterion of the two shapes: 1 if they are the same
  double error = 0;  ///< relative error of the frequency, >= 0; 1 if mac < 0.8: not found again
};

/// Description of a basis vector.
struct ModeRecord {
  std::string name;  ///< e.g. "fore-aft bending 1"
  std::string kind;  ///< e.g. "normal", an eigenvector: see basis_kind.h
  /// Energy fractions of the plates' rigid motions, per cent of their kinetic energy: fore-aft (x
  /// with theta_y), lateral (y with theta_x), twist (theta_z), axial (z).
  std::array<double, 4> shares_percent{};
  double residual = 0;                       ///< ||K x - lambda M x|| / ||K x||
  std::optional<MeshError> mesh_error = {};  ///< that of a normal mode, if it was estimated
};

/// Frequencies of the finite element model with a rigid body fixed to an interface, without
/// gravity.
struct AttachedFrequencies {
  std::string body;       ///< name of the rigid body
  std::string interface;  ///< name of the interface it is fixed to
  Eigen::VectorXd frequencies_Hz;
  /// Mass matrix of the rigid body about the interface, translation (3) and rotation (3).
  std::optional<Eigen::Matrix<double, 6, 6>> mass_matrix = std::nullopt;
};

/// A deformable body reduced to m mass-normalised modes in its body frame, which moves with the
/// fixed nodes. Row k of a shape belongs to row k of `nodes_m`.
struct ModalBody {
  Eigen::VectorXd frequencies_Hz;  ///< (m), ascending
  std::vector<ModeRecord> modes;   ///< m of them
  std::string boundary;            ///< supports, e.g. "fixed: bolts"
  std::string prestress = {};      ///< loads whose stresses the modes are about; may be empty
  /// (m), contribution of the geometric stiffness of these stresses to (2 pi f)^2, 1/s^2; may be
  /// empty.
  Eigen::VectorXd prestress_stiffness = {};
  std::string completeness;  ///< result of the Sturm sequence check; "not checked" without one
  /// Reason why the errors of the mesh are only an indication; empty if they are more, or not
  /// estimated.
  std::string mesh_error_limits = {};
  std::string solver;                    ///< method of solution; may be empty
  double orthogonality = 0;              ///< largest |Psi^T M Psi - I|
  Eigen::Matrix3Xd nodes_m;              ///< (3, n)
  std::vector<Eigen::Matrix3Xd> shapes;  ///< m of (3, n), kg^(-1/2)
  std::vector<Interface> interfaces;
  InertiaInvariants invariants;
  std::vector<AttachedFrequencies> attached;                             ///< may be empty
  std::optional<GeometricStiffness> geometric_stiffness = std::nullopt;  ///< if requested
  std::vector<SlitMotion> slits = {};  ///< motions of open slits, if they join the basis

  Eigen::Index mode_count() const { return frequencies_Hz.size(); }
  /// @throws InputError if there is no interface of that name; the message lists the names.
  const Interface& interface(const std::string& name) const;
  Eigen::Index mode_index(const std::string& name) const;
};

/// Names that a selection of modes stands for, in the order given: a kind (basis_kind.h) in place
/// of a name stands for all modes of that kind, "all" for all that are not rigid motions.
std::vector<std::string> selected_names(const ModalBody& body,
                                        const std::vector<std::string>& names);
/// Reduces the body further to these modes.
/// @throws InputError for a name that the body has not, or one that comes twice.
ModalBody select_modes(const ModalBody& body, const std::vector<std::string>& names);

}  // namespace flexneck::fe_modal
