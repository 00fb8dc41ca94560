// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/parameter_studies/evaluation/modes_slopes.h"

#include <algorithm>
#include <array>
#include <utility>

#include "fe_modal/analysis/modal_analysis.h"
#include "fe_modal/analysis/sensitivity.h"
#include "geometry/foundation/error.h"
#include "mesher/mesh/node_velocity.h"
#include "pipeline/parameter_studies/evaluation/figures.h"
#include "pipeline/parameter_studies/evaluation/modes_options.h"
#include "pipeline/run/make_mesh.h"
#include "pipeline/run/results_folder.h"

namespace flexneck::pipeline {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr std::array<double mesher::Material::*, 3> kConstants = {
    &mesher::Material::youngs_modulus_Pa, &mesher::Material::poissons_ratio,
    &mesher::Material::density_kg_m3};
constexpr std::array<fe_modal::MaterialConstant, 3> kConstantKinds = {
    fe_modal::MaterialConstant::youngs_modulus, fe_modal::MaterialConstant::poissons_ratio,
    fe_modal::MaterialConstant::density};

/// Text of the values on which the modes depend besides those of the mesh.
std::string text_beside_mesh(const Study& study) {
  std::vector<std::string> of_mesh;
  for (const Parameter& each : mesh_values(study)) of_mesh.push_back(each.key);
  std::string text;
  for (const Parameter& each : modes_values(study, true))
    if (std::find(of_mesh.begin(), of_mesh.end(), each.key) == of_mesh.end())
      text += each.key + '\n' + each.value + '\n';
  return text;
}

std::vector<mesher::Mesh> meshes_of(const std::vector<MovedStudy>& moved, const Console& console) {
  std::vector<const Study*> studies;
  studies.reserve(moved.size());
  for (const MovedStudy& each : moved) studies.push_back(&each.study);
  std::vector<mesher::Mesh> meshes;
  for (MeshOutcome& outcome : make_meshes(studies, console)) {
    if (!outcome.mesh) throw InputError(outcome.refusal);
    meshes.push_back(std::move(*outcome.mesh));
  }
  return meshes;
}

/// Parameters: first the motion of the nodes for each number, then all constants of all materials.
std::vector<fe_modal::DesignParameter> design_parameters(const mesher::Mesh& mesh,
                                                         const std::vector<mesher::Mesh>& others,
                                                         const std::vector<MovedStudy>& moved) {
  std::vector<fe_modal::DesignParameter> parameters;
  for (std::size_t k = 0; k < moved.size(); ++k)
    parameters.push_back({"number " + std::to_string(k), "1", 1,
                          mesher::node_velocity(mesh, mesh, others[k], moved[k].width)});
  for (std::size_t m = 0; m < mesh.materials.size(); ++m)
    for (std::size_t c = 0; c < kConstants.size(); ++c)
      parameters.push_back({mesh.materials[m].name, "1", mesh.materials[m].*kConstants.at(c),
                            fe_modal::MaterialParameter{m, kConstantKinds.at(c)}});
  return parameters;
}

/// Derivatives by the numbers: through the nodes, and through the materials that they change.
MatrixXd by_numbers(const MatrixXd& by_parameters, const mesher::Mesh& mesh,
                    const std::vector<mesher::Mesh>& others, const std::vector<MovedStudy>& moved) {
  const auto count = static_cast<Index>(moved.size());
  MatrixXd found = by_parameters.leftCols(count);
  for (Index k = 0; k < count; ++k) {
    const auto place = static_cast<std::size_t>(k);
    Index column = count;
    for (std::size_t m = 0; m < mesh.materials.size(); ++m)
      for (const auto constant : kConstants)
        found.col(k) += by_parameters.col(column++) *
                        (others[place].materials.at(m).*constant - mesh.materials[m].*constant) /
                        moved[place].width;
  }
  return found;
}

/// Row of a frequency: its own, or the row of the mean of a nearly equal group that it belongs to.
Index row_of_frequency(const fe_modal::Sensitivities& found, const std::string& name,
                       bool is_attached) {
  Index mean = -1;
  for (std::size_t k = 0; k < found.quantities.size(); ++k) {
    const fe_modal::Quantity& each = found.quantities[k];
    if (each.is_attached != is_attached) continue;
    const bool is_own = each.kind == fe_modal::QuantityKind::frequency ||
                        each.kind == fe_modal::QuantityKind::symmetry_class;
    if (is_own && each.name == name) return static_cast<Index>(k);
    const bool is_among = each.kind == fe_modal::QuantityKind::mean_frequency &&
                          (", " + each.name + ",").find(", " + name + ",") != std::string::npos;
    if (is_among) mean = static_cast<Index>(k);
  }
  if (mean < 0) throw InputError("there is no derivative of the frequency of '" + name + "'");
  return mean;
}

Index row_of(const fe_modal::Sensitivities& found, const fe_modal::ModalBody& body,
             const std::string& figure) {
  if (figure == kMass) {
    const auto row =
        std::find_if(found.quantities.begin(), found.quantities.end(),
                     [](const auto& each) { return each.kind == fe_modal::QuantityKind::mass; });
    return row - found.quantities.begin();
  }
  if (figure == kSystemFrequency) {
    const fe_modal::AttachedFrequencies& attached = body.attached.at(0);
    return row_of_frequency(found, attached.body + " on " + attached.interface + " 1", true);
  }
  if (is_stiffness_figure(figure)) {
    const auto row = std::find_if(found.quantities.begin(), found.quantities.end(),
                                  [&](const fe_modal::Quantity& each) {
                                    return each.kind == fe_modal::QuantityKind::static_stiffness &&
                                           each.name == stiffness_of_figure(figure);
                                  });
    return row - found.quantities.begin();
  }
  return row_of_frequency(found, body.modes[mode_of_figure(body, figure)].name, false);
}

}  // namespace

bool differ_in_mesh_only(const Study& a, const Study& b) {
  return text_beside_mesh(a) == text_beside_mesh(b);
}

bool has_modes_slopes(const Study& study) {
  return study.structure && !study.modes.prestress &&
         study.modes.basis != fe_modal::BasisKind::craig_bampton;
}

FigureSlopes modes_slopes(const Study& study, const mesher::Mesh& mesh, BodyUse use,
                          const std::vector<MovedStudy>& moved,
                          const std::vector<std::string>& figures, const Console& console) {
  mesher::Mesh solved = mesh;
  fe_modal::ModalOptions options = modes_options(study, solved);
  options.check = false;
  if (use != BodyUse::attached) options.attachments.clear();
  fe_modal::AnalysisFields fields;
  const fe_modal::ModalBody body =
      fe_modal::analyse_modes(solved, options, {}, nullptr, {}, &fields);
  static_cast<void>(rounding_remark(solved, options, body));  // throws if the result is wrong
  if (std::none_of(figures.begin(), figures.end(), is_stiffness_figure))
    fields.responses.clear();  // their derivatives are not needed
  const std::vector<mesher::Mesh> others = meshes_of(moved, console);
  const fe_modal::Sensitivities found = fe_modal::sensitivities(
      solved, options, body, fields, design_parameters(solved, others, moved));
  const MatrixXd all = by_numbers(found.derivatives, mesh, others, moved);
  FigureSlopes slopes{VectorXd(static_cast<Index>(figures.size())),
                      MatrixXd(static_cast<Index>(figures.size()), all.cols())};
  for (std::size_t k = 0; k < figures.size(); ++k) {
    slopes.values[static_cast<Index>(k)] = modes_figure(body, figures[k]);
    slopes.derivatives.row(static_cast<Index>(k)) = all.row(row_of(found, body, figures[k]));
  }
  return slopes;
}

}  // namespace flexneck::pipeline
