// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

#include "fe_modal/analysis/modal_analysis.h"
#include "fe_modal/analysis/spectrum_derivative.h"
#include "fe_modal/element/element_fields.h"
#include "fe_modal/element/energy_gradient.h"

namespace flexneck::fe_modal {

/// Eigenpairs as energy forms of fields.
struct SpectrumForms {
  Spectrum spectrum;
  Eigen::Index first_field = 0;
  /// Attached body and its interface; null if there is none.
  const AttachedFrequencies* attached = nullptr;
  std::size_t interface = 0;  ///< index in the options, if a body is attached
  std::vector<ModeGroup> groups;
  /// Index of each group's first form; forms are its upper triangle, row by row.
  std::vector<Eigen::Index> first_forms;
};

/// Responses of an interface to its six loads as energy forms of fields.
struct ResponseForms {
  std::size_t interface = 0;  ///< index in the options
  Eigen::Index first_field = 0;
  Eigen::Index first_form = 0;
};

/// All quantities to be differentiated, as forms of fields.
struct SensitivityRequest {
  Displacements fields;
  std::vector<EnergyForm> forms;
  std::vector<SpectrumForms> spectra;
  std::vector<ResponseForms> responses;
  /// For each of the options' interfaces: average motions of all fields, (6, fields); empty if not
  /// needed.
  std::vector<Eigen::MatrixXd> averages;
};

/// Requests the derivatives of all eigenpairs, responses and averages of a solution. The fields are
/// those of body and solved, which must outlive the request.
SensitivityRequest request_of(const mesher::Mesh& mesh, const ModalOptions& options,
                              const ModalBody& body, const AnalysisFields& solved);

}  // namespace flexneck::fe_modal
