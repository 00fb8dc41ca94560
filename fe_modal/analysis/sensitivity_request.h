// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

#include "fe_modal/analysis/modal_analysis.h"
#include "fe_modal/analysis/spectrum_derivative.h"
#include "fe_modal/element/element_fields.h"
#include "fe_modal/element/energy_gradient.h"

namespace flexneck::fe_modal {

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
struct SensitivityRequest {
  Displacements fields;
  std::vector<EnergyForm> forms;
  std::vector<SpectrumForms> spectra;
  std::vector<ResponseForms> responses;
  /// Of the options' interfaces: average motions of all fields, (6, fields); empty if nobody asks.
  std::vector<Eigen::MatrixXd> averages;
};

/// All eigenpairs, responses and averages of a solution. The fields are those of body and solved,
/// which must outlive the request.
SensitivityRequest request_of(const mesher::Mesh& mesh, const ModalOptions& options,
                              const ModalBody& body, const AnalysisFields& solved);

}  // namespace flexneck::fe_modal
