// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/parameter_studies/evaluation/structure_modes.h"

#include <utility>

#include <fmt/core.h>

#include "fe_modal/analysis/modal_analysis.h"
#include "fe_modal/element/rounding.h"
#include "fe_modal/exchange/exported_matrices.h"
#include "geometry/foundation/error.h"
#include "pipeline/parameter_studies/evaluation/modes_options.h"
#include "pipeline/parameter_studies/evaluation/substructures.h"

namespace flexneck::pipeline {

mesher::Mesh with_static_moduli(mesher::Mesh mesh, const MaterialModels& models) {
  for (mesher::Material& material : mesh.materials) {
    const auto model = models.find(material.name);
    if (model != models.end()) material.youngs_modulus_Pa *= model->second.static_modulus_ratio;
  }
  return mesh;
}

std::string rounding_remark(const mesher::Mesh& mesh, const fe_modal::ModalOptions& options,
                            const fe_modal::ModalBody& body) {
  constexpr double kWorthTelling = 1e-6;
  constexpr double kWrong = 1e-3;
  const double error = fe_modal::rounding_error(mesh, options.formulation, body);
  if (error <= kWorthTelling) return {};
  const std::string line = fmt::format("rounding moves the first frequency by {:.1e} of it: {}",
                                       error, fe_modal::cause_of_rounding(mesh));
  if (!(error < kWrong)) throw ComputationError(line);
  return line;
}

fe_modal::ModalBody modes_of_mesh(const Study& study, mesher::Mesh mesh, BodyUse use) {
  fe_modal::ModalOptions options = modes_options(study, mesh);
  options.check = false;
  if (use != BodyUse::attached) options.attachments.clear();
  if (use == BodyUse::static_tests)
    mesh = with_static_moduli(std::move(mesh), study.material_models());
  fe_modal::ModalBody body = fe_modal::analyse_modes(mesh, options, {});
  static_cast<void>(rounding_remark(mesh, options, body));  // throws if the result is wrong
  return body;
}

Pieces modes_of_pieces(const Study& study, mesher::Mesh mesh) {
  fe_modal::ModalOptions options = modes_options(study, mesh);
  Pieces pieces;
  for (const Substructure& piece : substructures_of(study, mesh, options)) {
    fe_modal::ModalBody body = fe_modal::analyse_modes(piece.mesh, piece.options, {});
    require_rigid_face(study, piece, body);
    pieces.emplace(piece.name, without_shapes(std::move(body)));
  }
  return pieces;
}

fe_modal::ModalBody solved_matrices(const Study& study) {
  const MatricesSection& files = *study.matrices;
  const fe_modal::ImportedBody matrices{fe_modal::read_matrix(files.stiffness),
                                        fe_modal::read_matrix(files.mass),
                                        fe_modal::read_positions(files.nodes)};
  fe_modal::ModalOptions options = options_of_solution(study);
  options.check = false;
  return fe_modal::analyse_matrices(matrices, options, {}, {});
}

fe_modal::ModalBody without_shapes(fe_modal::ModalBody body) {
  for (Eigen::Matrix3Xd& shape : body.shapes) shape.resize(3, 0);
  if (body.nodes_m.cols() < 2) return body;
  Eigen::Matrix3Xd corners(3, 2);
  corners << body.nodes_m.rowwise().minCoeff(), body.nodes_m.rowwise().maxCoeff();
  body.nodes_m = corners;
  return body;
}

}  // namespace flexneck::pipeline
