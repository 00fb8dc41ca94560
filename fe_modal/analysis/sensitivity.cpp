// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/analysis/sensitivity.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "fe_modal/analysis/attached_frequencies.h"
#include "fe_modal/analysis/average_derivative.h"
#include "fe_modal/analysis/body_gradient.h"
#include "fe_modal/analysis/spectrum_derivative.h"
#include "geometry/foundation/error.h"

namespace flexneck::fe_modal {
namespace {

constexpr std::array<std::string_view, 6> kKindNames = {
    "frequency", "mean", "directional", "symmetry class", "mass", "static stiffness"};
constexpr std::array<const char*, 6> kLoads = {"Fx/ux", "Fy/uy", "Fz/uz",
                                               "Mx/rx", "My/ry", "Mz/rz"};

/// Eigenpairs as forms of fields.
struct SpectrumForms {
  Spectrum spectrum;
  Eigen::Index first_field = 0;
  const AttachedFrequencies* attached = nullptr;  ///< the body and where it is, if it is one
  std::size_t interface = 0;                      ///< likewise, of the options
  std::vector<ModeGroup> groups;
  std::vector<Eigen::Index> first_forms;  ///< of each group: its upper triangle, row by row
};

/// The responses of an interface to its six loads as forms of fields.
struct ResponseForms {
  std::size_t interface = 0;  ///< of the options
  Eigen::Index first_field = 0;
  Eigen::Index first_form = 0;
};

/// All that is to be differentiated.
struct Request {
  Displacements fields;
  std::vector<EnergyForm> forms;
  std::vector<SpectrumForms> spectra;
  std::vector<ResponseForms> responses;
  /// Of the options' interfaces: average motions of all fields, (6, fields); empty if nobody asks.
  std::vector<Eigen::MatrixXd> averages;
};

/// Derivatives by one parameter.
struct ByParameter {
  Eigen::VectorXd forms;
  double mass = 0;
  std::vector<Eigen::MatrixXd> averages;  ///< as in the request
};

double eigenvalue(double frequency_Hz) { return std::pow(2 * std::numbers::pi * frequency_Hz, 2); }

void add_forms(SpectrumForms& forms, Request& request) {
  const Eigen::VectorXd& frequencies = forms.spectrum.frequencies_Hz;
  forms.groups = groups_of(frequencies);
  for (const ModeGroup& group : forms.groups) {
    forms.first_forms.push_back(static_cast<Eigen::Index>(request.forms.size()));
    for (Eigen::Index i = group.first; i < group.first + group.count; ++i) {
      for (Eigen::Index j = i; j < group.first + group.count; ++j) {
        const double lambda = (eigenvalue(frequencies[i]) + eigenvalue(frequencies[j])) / 2;
        request.forms.push_back({forms.first_field + i, forms.first_field + j, lambda});
      }
    }
  }
}

void add_shape(const Eigen::Matrix3Xd& shape, const std::string& name, double frequency_Hz,
               SpectrumForms& forms, Request& request) {
  Spectrum& spectrum = forms.spectrum;
  if (spectrum.names.empty()) {
    forms.first_field = static_cast<Eigen::Index>(request.fields.size());
  }
  spectrum.names.push_back(name);
  spectrum.frequencies_Hz.conservativeResize(spectrum.frequencies_Hz.size() + 1);
  spectrum.frequencies_Hz.tail<1>()[0] = frequency_Hz;
  request.fields.push_back(&shape);
}

void request_modes(const ModalBody& body, Request& request) {
  SpectrumForms forms;
  for (std::size_t k = 0; k < body.modes.size(); ++k) {
    if (body.modes[k].kind != kNormalMode) continue;
    add_shape(body.shapes[k], body.modes[k].name, body.frequencies_Hz[static_cast<Eigen::Index>(k)],
              forms, request);
  }
  add_forms(forms, request);
  request.spectra.push_back(std::move(forms));
}

void request_attached(const ModalOptions& options, const ModalBody& body,
                      const AnalysisFields& solved, Request& request) {
  for (std::size_t k = 0; k < body.attached.size(); ++k) {
    const AttachedFrequencies& attached = body.attached[k];
    SpectrumForms forms;
    forms.spectrum.is_attached = true;
    forms.attached = &attached;
    forms.interface = interface_index(options, attached.interface);
    const std::string name = attached.body + " on " + attached.interface + " ";
    const std::vector<Eigen::Matrix3Xd>& shapes = solved.attached_shapes.at(k);
    for (std::size_t m = 0; m < shapes.size(); ++m) {
      add_shape(shapes[m], name + std::to_string(m + 1),
                attached.frequencies_Hz[static_cast<Eigen::Index>(m)], forms, request);
    }
    add_forms(forms, request);
    request.spectra.push_back(std::move(forms));
  }
}

void request_responses(const AnalysisFields& solved, Request& request) {
  for (std::size_t k = 0; k < solved.responses.size(); ++k) {
    request.responses.push_back({k, static_cast<Eigen::Index>(request.fields.size()),
                                 static_cast<Eigen::Index>(request.forms.size())});
    for (const Eigen::Matrix3Xd& response : solved.responses[k]) {
      const auto field = static_cast<Eigen::Index>(request.fields.size());
      request.forms.push_back({field, field, 0});
      request.fields.push_back(&response);
    }
  }
}

void request_averages(const mesher::Mesh& mesh, const ModalOptions& options, Request& request) {
  request.averages.resize(options.interfaces.size());
  std::vector<std::size_t> needed;
  for (const SpectrumForms& forms : request.spectra) {
    if (forms.attached != nullptr) needed.push_back(forms.interface);
  }
  for (const ResponseForms& forms : request.responses) needed.push_back(forms.interface);
  for (const std::size_t k : needed) {
    if (request.averages[k].size() > 0) continue;
    const InterfaceDefinition& interface = options.interfaces[k];
    request.averages[k] = averages_of(
        RigidAverage(mesh, mesh.face_set(interface.set), interface.position_m), request.fields);
  }
}

ByParameter derivative_by(const DesignParameter& parameter, const mesher::Mesh& mesh,
                          const ModalOptions& options, const Request& request,
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
    result.averages[k] = average_derivative(mesh, mesh.face_set(interface.set),
                                            interface.position_m, velocity, request.fields);
  }
  return result;
}

GroupDerivative group_derivative(const SpectrumForms& forms, std::size_t which,
                                 const Request& request, const std::vector<ByParameter>& all) {
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

void add_stiffness(const ResponseForms& forms, const ModalOptions& options, const Request& request,
                   const std::vector<ByParameter>& all, Sensitivities& result) {
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
             std::string(kLoads.at(static_cast<std::size_t>(i))) + " at " +
                 options.interfaces[forms.interface].name,
             i < 3 ? "N/m" : "N m/rad", stiffness},
            by_parameter, result);
  }
}

void check_basis(const ModalOptions& options) {
  if (options.basis == BasisKind::craig_bampton) {
    throw InputError(
        "sensitivities need eigenvectors of the body, a basis of craig-bampton has none; take "
        "modes.basis = \"residual\"");
  }
  const bool is_tied = std::any_of(options.interfaces.begin(), options.interfaces.end(),
                                   [](const auto& interface) { return interface.is_rigid; });
  if (is_tied) {
    throw InputError(
        "sensitivities are not offered with rigid interfaces, whose couplings move with the "
        "nodes; leave out modes.rigid_interfaces");
  }
}

/// Of the last modes their group may go on beyond them.
void note_cut_group(const Request& request, const AnalysisFields& solved, Sensitivities& result) {
  const Spectrum& modes = request.spectra.front().spectrum;
  if (modes.names.empty()) return;
  const double last_Hz = modes.frequencies_Hz.tail<1>()[0];
  if (!(solved.next_Hz - last_Hz < kNearlyEqual * solved.next_Hz)) return;
  result.notes.push_back(modes.names.back() +
                         " lies within 1 % of the next mode, which was not asked for: raise "
                         "modes.count, its derivatives are those of a single mode");
}

}  // namespace

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
  Request request;
  request_modes(body, request);
  request_attached(options, body, fields, request);
  request_responses(fields, request);
  request_averages(mesh, options, request);
  const BodyGradient gradient =
      body_gradient(mesh, options.formulation, request.fields, request.forms);

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
