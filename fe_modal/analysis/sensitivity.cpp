// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/analysis/sensitivity.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "fe_modal/analysis/average_derivative.h"
#include "fe_modal/analysis/body_gradient.h"
#include "fe_modal/analysis/sensitivity_request.h"
#include "fe_modal/analysis/spectrum_derivative.h"
#include "fe_modal/dofs/dof_map.h"
#include "geometry/foundation/error.h"
#include "mesher/mesh/positions.h"

namespace flexneck::fe_modal {

namespace {

/// K u and M u of all fields at the nodes of a coupling, N and kg m; zero elsewhere.
struct NodalForces {
  std::vector<Eigen::Matrix3Xd> elastic;  ///< (3, n) for each field
  std::vector<Eigen::Matrix3Xd> inertial;
};

void add_element(std::span<const std::int32_t> nodes, const std::vector<bool>& is_coupled,
                 const ElementMatrices& element, const Eigen::MatrixXd& values,
                 NodalForces& forces) {
  const auto n = static_cast<Eigen::Index>(nodes.size());
  const Eigen::MatrixXd elastic = element.stiffness * values;
  for (std::size_t f = 0; f < forces.elastic.size(); ++f) {
    const auto column = static_cast<Eigen::Index>(f);
    for (Eigen::Index a = 0; a < 3; ++a) {
      const Eigen::VectorXd inertial = element.mass * values.col(column).segment(a * n, n);
      for (Eigen::Index i = 0; i < n; ++i) {
        const std::int32_t node = nodes[static_cast<std::size_t>(i)];
        if (!is_coupled[static_cast<std::size_t>(node)]) continue;
        forces.elastic[f](a, node) += elastic(a * n + i, column);
        forces.inertial[f](a, node) += inertial[i];
      }
    }
  }
}

/// Sums the forces of the elements that touch the coupling.
NodalForces forces_on(const std::vector<bool>& is_coupled, const mesher::Mesh& mesh,
                      const FormulationChoice& formulation, const Displacements& fields) {
  const Eigen::Matrix3Xd zero =
      Eigen::Matrix3Xd::Zero(3, static_cast<Eigen::Index>(mesh.nodes.size()));
  NodalForces forces{std::vector(fields.size(), zero), std::vector(fields.size(), zero)};
  ElementMatrices element;
  Eigen::Matrix3Xd coordinates;
  Eigen::MatrixXd values;
  for (const mesher::ElementBlock& block : mesh.blocks) {
    const mesher::Material& material = mesh.materials.at(block.material);
    ElementKernel kernel(element_scheme(block.kind, formulation.of(material)));
    const std::size_t width = mesher::nodes_per_element(block.kind);
    for (std::size_t e = 0; e < block.size(); ++e) {
      const auto nodes = std::span(block.nodes).subspan(width * e, width);
      const bool touches = std::any_of(nodes.begin(), nodes.end(), [&](std::int32_t node) {
        return is_coupled[static_cast<std::size_t>(node)];
      });
      if (!touches) continue;
      mesher::copy_positions(mesh, nodes, coordinates);
      gather(nodes, fields, values);
      kernel.compute(coordinates, material, element);
      add_element(nodes, is_coupled, element, values, forces);
    }
  }
  return forces;
}

/// Adds to a gradient the contribution of rigid couplings, which change the fields themselves:
/// where a node of a coupling moves with v, its displacement t + theta x (x - point) changes by
/// theta x v, and u^T A w by (A u) . (theta_w x v) + (A w) . (theta_u x v) with A = K - lambda M.
/// @param nodes those of the coupling
/// @param rotations theta of each field, (3, fields), rad
/// @throws InputError and ComputationError as element_scheme and ElementKernel.
void add_coupling_gradient(const mesher::Mesh& mesh, const FormulationChoice& formulation,
                           const std::vector<std::int32_t>& nodes,
                           const Eigen::Matrix3Xd& rotations, const Displacements& fields,
                           const std::vector<EnergyForm>& forms, BodyGradient& gradient) {
  std::vector<bool> is_coupled(mesh.nodes.size());
  for (const std::int32_t node : nodes) is_coupled[static_cast<std::size_t>(node)] = true;
  const NodalForces forces = forces_on(is_coupled, mesh, formulation, fields);
  const auto force = [&](Eigen::Index field, double lambda, std::int32_t node) -> Eigen::Vector3d {
    const auto place = static_cast<std::size_t>(field);
    return forces.elastic[place].col(node) - lambda * forces.inertial[place].col(node);
  };
  for (std::size_t k = 0; k < forms.size(); ++k) {
    const auto& [one, other, lambda] = forms[k];
    const Eigen::Vector3d of_one = rotations.col(one);
    const Eigen::Vector3d of_other = rotations.col(other);
    for (const std::int32_t node : nodes) {
      gradient.by_nodes[k].col(node) +=
          force(one, lambda, node).cross(of_other) + force(other, lambda, node).cross(of_one);
    }
  }
}

constexpr std::array<std::string_view, 6> kKindNames = {
    "frequency", "mean", "directional", "symmetry class", "mass", "static stiffness"};
constexpr std::array<const char*, 6> kLoads = {"Fx/ux", "Fy/uy", "Fz/uz",
                                               "Mx/rx", "My/ry", "Mz/rz"};

/// Derivatives with respect to one parameter.
struct ByParameter {
  Eigen::VectorXd forms;
  double mass = 0;
  std::vector<Eigen::MatrixXd> averages;  ///< one for each of the request's averages
};

ByParameter derivative_by(const DesignParameter& parameter, const mesher::Mesh& mesh,
                          const ModalOptions& options, const SensitivityRequest& request,
                          const BodyGradient& gradient) {
  ByParameter result{Eigen::VectorXd(static_cast<Eigen::Index>(request.forms.size())), 0,
                     request.averages};
  if (const auto* const constant = std::get_if<MaterialParameter>(&parameter.change)) {
    result.forms = gradient.by_material.at(constant->material)
                       .col(static_cast<Eigen::Index>(constant->constant));
    if (constant->constant == MaterialConstant::density) {
      result.mass = gradient.volumes_m3[static_cast<Eigen::Index>(constant->material)];
    }
    for (Eigen::MatrixXd& average : result.averages) average.setZero();
    return result;
  }
  const auto& velocity = std::get<Eigen::Matrix3Xd>(parameter.change);
  for (std::size_t k = 0; k < request.forms.size(); ++k) {
    result.forms[static_cast<Eigen::Index>(k)] = gradient.by_nodes[k].cwiseProduct(velocity).sum();
  }
  result.mass = gradient.mass_by_nodes.cwiseProduct(velocity).sum();
  for (std::size_t k = 0; k < result.averages.size(); ++k) {
    if (result.averages[k].size() == 0) continue;
    const InterfaceDefinition& interface = options.interfaces[k];
    // The motion is a degree of freedom, independent of its nodes' positions.
    if (interface.is_rigid) {
      result.averages[k].setZero();
      continue;
    }
    result.averages[k] = average_derivative(mesh, mesh.face_set(interface.set),
                                            interface.position_m, velocity, request.fields);
  }
  return result;
}

GroupDerivative group_derivative(const SpectrumForms& forms, std::size_t which,
                                 const SensitivityRequest& request,
                                 const std::vector<ByParameter>& all) {
  GroupDerivative result{forms.groups[which], {}};
  const Eigen::Index count = result.group.count;
  for (const ByParameter& by : all) {
    Eigen::MatrixXd matrix(count, count);
    Eigen::Index form = forms.first_forms[which];
    for (Eigen::Index i = 0; i < count; ++i) {
      for (Eigen::Index j = i; j < count; ++j, ++form) {
        double value = by.forms[form];
        if (forms.attached != nullptr) {
          const EnergyForm& pair = request.forms[static_cast<std::size_t>(form)];
          const Eigen::MatrixXd& motions = request.averages[forms.interface];
          const Eigen::MatrixXd& changes = by.averages[forms.interface];
          const Matrix6d& mass = *forms.attached->mass_matrix;
          value -= pair.lambda * (changes.col(pair.one).dot(mass * motions.col(pair.other)) +
                                  motions.col(pair.one).dot(mass * changes.col(pair.other)));
        }
        matrix(i, j) = matrix(j, i) = value;
      }
    }
    result.by_parameter.push_back(std::move(matrix));
  }
  return result;
}

void add_row(Quantity quantity, const Eigen::VectorXd& by_parameter, Sensitivities& result) {
  result.quantities.push_back(std::move(quantity));
  result.derivatives.conservativeResize(result.derivatives.rows() + 1, by_parameter.size());
  result.derivatives.bottomRows<1>() = by_parameter.transpose();
}

void add_stiffness(const ResponseForms& forms, const ModalOptions& options,
                   const SensitivityRequest& request, const std::vector<ByParameter>& all,
                   Sensitivities& result) {
  for (Eigen::Index i = 0; i < 6; ++i) {
    const Eigen::Index field = forms.first_field + i;
    const double stiffness = 1 / request.averages[forms.interface](i, field);
    Eigen::VectorXd by_parameter(static_cast<Eigen::Index>(all.size()));
    for (std::size_t p = 0; p < all.size(); ++p) {
      const double compliance =
          2 * all[p].averages[forms.interface](i, field) - all[p].forms[forms.first_form + i];
      by_parameter[static_cast<Eigen::Index>(p)] = -stiffness * stiffness * compliance;
    }
    add_row({QuantityKind::static_stiffness,
             stiffness_name(static_cast<std::size_t>(i), options.interfaces[forms.interface].name),
             i < 3 ? "N/m" : "N m/rad", stiffness},
            by_parameter, result);
  }
}

/// Refuses an interface that shares nodes with a rigid one: the average motion of rigidly coupled
/// nodes does not follow from fields that stay fixed as nodes move.
void check_overlap(const mesher::Mesh& mesh, const ModalOptions& options) {
  const auto nodes_of = [&](const InterfaceDefinition& interface) {
    return mesher::nodes_of(mesh.face_set(interface.set)).nodes;
  };
  for (const InterfaceDefinition& rigid : options.interfaces) {
    for (const InterfaceDefinition& other : options.interfaces) {
      if (!rigid.is_rigid || other.is_rigid) continue;
      const std::vector<std::int32_t> one = nodes_of(rigid);
      const std::vector<std::int32_t> two = nodes_of(other);
      std::vector<std::int32_t> shared;
      std::set_intersection(one.begin(), one.end(), two.begin(), two.end(),
                            std::back_inserter(shared));
      if (shared.empty()) continue;
      throw InputError("sensitivities are not supported if interface '" + other.name +
                       "' shares nodes with the rigid interface '" + rigid.name +
                       "'; make it rigid as well, in modes.rigid_interfaces");
    }
  }
}

/// Refuses constraints whose coefficients change with the positions of nodes.
void check_connections(const mesher::Connections& connections) {
  const auto turns = [](const mesher::Support& support) { return support.axes.is_cylindrical; };
  if (connections.couplings.empty() && connections.equations.empty() &&
      std::none_of(connections.supports.begin(), connections.supports.end(), turns)) {
    return;
  }
  throw InputError(
      "sensitivities are not supported with couplings, equations or supports in cylindrical axes");
}

void check_basis(const ModalOptions& options) {
  if (options.basis == BasisKind::craig_bampton) {
    throw InputError(
        "sensitivities need eigenvectors of the body, which a Craig-Bampton basis does not "
        "contain; use modes.basis = \"residual\"");
  }
}

/// Adds the contribution of the couplings of rigid interfaces.
void add_couplings(const mesher::Mesh& mesh, const ModalOptions& options,
                   const SensitivityRequest& request, BodyGradient& gradient) {
  for (std::size_t k = 0; k < options.interfaces.size(); ++k) {
    const InterfaceDefinition& interface = options.interfaces[k];
    if (!interface.is_rigid) continue;
    add_coupling_gradient(
        mesh, options.formulation, mesher::nodes_of(mesh.face_set(interface.set)).nodes,
        request.averages[k].bottomRows<3>(), request.fields, request.forms, gradient);
  }
}

/// Adds a note if the last modes may belong to a group that continues beyond them.
void note_cut_group(const SensitivityRequest& request, const AnalysisFields& solved,
                    Sensitivities& result) {
  const Spectrum& modes = request.spectra.front().spectrum;
  if (modes.names.empty()) return;
  const double last_Hz = modes.frequencies_Hz.tail<1>()[0];
  if (!(solved.next_Hz - last_Hz < kNearlyEqual * solved.next_Hz)) return;
  result.notes.push_back(modes.names.back() +
                         " is within 1 % of the next mode, which was not computed, and its "
                         "derivatives assume a single mode; increase modes.count");
}

}  // namespace

std::string stiffness_name(std::size_t load, const std::string& interface) {
  return std::string(kLoads.at(load)) + " at " + interface;
}

std::string_view name_of(QuantityKind kind) {
  return kKindNames.at(static_cast<std::size_t>(kind));
}

Eigen::MatrixXd Sensitivities::relative() const {
  Eigen::MatrixXd result = derivatives;
  for (Eigen::Index q = 0; q < result.rows(); ++q)
    result.row(q) /= quantities[static_cast<std::size_t>(q)].value;
  for (Eigen::Index p = 0; p < result.cols(); ++p)
    result.col(p) *= parameters[static_cast<std::size_t>(p)].value;
  return result;
}

Sensitivities sensitivities(const mesher::Mesh& mesh, const ModalOptions& options,
                            const ModalBody& body, const AnalysisFields& fields,
                            std::vector<DesignParameter> parameters) {
  check_basis(options);
  check_overlap(mesh, options);
  check_connections(mesh.connections);
  const SensitivityRequest request = request_of(mesh, options, body, fields);
  BodyGradient gradient = body_gradient(mesh, options.formulation, request.fields, request.forms);
  add_couplings(mesh, options, request, gradient);

  std::vector<ByParameter> all;
  Sensitivities result;
  for (DesignParameter& parameter : parameters) {
    all.push_back(derivative_by(parameter, mesh, options, request, gradient));
    if (std::holds_alternative<Eigen::Matrix3Xd>(parameter.change))
      parameter.change = Eigen::Matrix3Xd();
    result.parameters.push_back(std::move(parameter));
  }
  result.derivatives.resize(0, static_cast<Eigen::Index>(all.size()));
  for (const SpectrumForms& forms : request.spectra) {
    for (std::size_t k = 0; k < forms.groups.size(); ++k)
      add_group(forms.spectrum, group_derivative(forms, k, request, all), result);
  }
  for (const ResponseForms& forms : request.responses)
    add_stiffness(forms, options, request, all, result);
  Eigen::VectorXd mass(static_cast<Eigen::Index>(all.size()));
  for (std::size_t p = 0; p < all.size(); ++p) mass[static_cast<Eigen::Index>(p)] = all[p].mass;
  add_row({QuantityKind::mass, "mass", "kg", body.invariants.mass}, mass, result);
  note_cut_group(request, fields, result);
  return result;
}

}  // namespace flexneck::fe_modal
