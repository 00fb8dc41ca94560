// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/analysis/sensitivity_request.h"

#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "fe_modal/analysis/attached_frequencies.h"
#include "fe_modal/analysis/average_derivative.h"

namespace flexneck::fe_modal {
namespace {

double eigenvalue(double frequency_Hz) { return std::pow(2 * std::numbers::pi * frequency_Hz, 2); }

void add_forms(SpectrumForms& forms, SensitivityRequest& request) {
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
               SpectrumForms& forms, SensitivityRequest& request) {
  Spectrum& spectrum = forms.spectrum;
  if (spectrum.names.empty()) {
    forms.first_field = static_cast<Eigen::Index>(request.fields.size());
  }
  spectrum.names.push_back(name);
  spectrum.frequencies_Hz.conservativeResize(spectrum.frequencies_Hz.size() + 1);
  spectrum.frequencies_Hz.tail<1>()[0] = frequency_Hz;
  request.fields.push_back(&shape);
}

void request_modes(const ModalBody& body, SensitivityRequest& request) {
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
                      const AnalysisFields& solved, SensitivityRequest& request) {
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

void request_responses(const AnalysisFields& solved, SensitivityRequest& request) {
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

void request_averages(const mesher::Mesh& mesh, const ModalOptions& options,
                      SensitivityRequest& request) {
  request.averages.resize(options.interfaces.size());
  std::vector<std::size_t> needed;
  for (const SpectrumForms& forms : request.spectra) {
    if (forms.attached != nullptr) needed.push_back(forms.interface);
  }
  for (const ResponseForms& forms : request.responses) needed.push_back(forms.interface);
  for (std::size_t k = 0; k < options.interfaces.size(); ++k)
    if (options.interfaces[k].is_rigid) needed.push_back(k);
  for (const std::size_t k : needed) {
    if (request.averages[k].size() > 0) continue;
    const InterfaceDefinition& interface = options.interfaces[k];
    request.averages[k] = averages_of(
        RigidAverage(mesh, mesh.face_set(interface.set), interface.position_m), request.fields);
  }
}

}  // namespace

SensitivityRequest request_of(const mesher::Mesh& mesh, const ModalOptions& options,
                              const ModalBody& body, const AnalysisFields& solved) {
  SensitivityRequest request;
  request_modes(body, request);
  request_attached(options, body, solved, request);
  request_responses(solved, request);
  request_averages(mesh, options, request);
  return request;
}

}  // namespace flexneck::fe_modal
