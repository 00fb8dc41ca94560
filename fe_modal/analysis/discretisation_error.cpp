// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/analysis/discretisation_error.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <utility>

#include "fe_modal/algebra/matrix_product.h"
#include "fe_modal/analysis/prestress.h"
#include "fe_modal/solve/eigensolver.h"
#include "fe_modal/solve/mechanism.h"
#include "fe_modal/system/memory_needs.h"
#include "geometry/foundation/available_memory.h"
#include "mesher/mesh/boundary.h"
#include "mesher/mesh/refinement.h"

namespace flexneck::fe_modal {
namespace {

/// Estimated error over the change, relative, that a finer mesh makes.
///
/// With every element cut in eight the error becomes 2^-p of what it was, so that it is
/// 1 / (1 - 2^-p) of the change: at most two with the order p = 1 that singular edges leave at
/// worst. For meshes so coarse that they do not show their order yet comes a safety factor of 1.5
/// (Roache, J. Fluids Eng. 116 (1994) 405, multiplies likewise).
constexpr double kOfCut = 1.5 * 2;
/// Quadratic elements in place of linear ones leave a part of the error.
constexpr double kOfRaised = 1.5;
/// Modes this close in frequency may turn into one another from mesh to mesh: they are one shape.
/// Rounding sets those of a square beam 1600 times as long as thick 1.2 % apart.
constexpr double kOneShape = 2e-2;
/// Less similar shapes are not the same mode, and nothing is known of the error.
constexpr double kSameMode = 0.8;
constexpr double kUnknown = 1;
/// Modes of the finer mesh beyond those of the coarse one, with which they may change places.
constexpr Eigen::Index kMore = 2;
constexpr double kCutInEight = 8;
/// So many times as many are searched for one that changes places with many.
constexpr Eigen::Index kMost = 8;

double hertz(double eigenvalue) {
  return std::sqrt(std::max(eigenvalue, 0.0)) / (2 * std::numbers::pi);
}

/// Finds a coarse mode among the finer ones.
/// @param similarity its modal assurance criterion with each of them
MeshError compare(double coarse_Hz, const Eigen::VectorXd& fine_Hz,
                  const Eigen::VectorXd& similarity, double error_over_change) {
  Eigen::Index nearest = 0;
  similarity.maxCoeff(&nearest);
  MeshError result;
  double weighted = 0;
  for (Eigen::Index j = 0; j < fine_Hz.size(); ++j) {
    if (std::abs(fine_Hz[j] - fine_Hz[nearest]) > kOneShape * fine_Hz[nearest]) continue;
    result.mac += similarity[j];
    weighted += similarity[j] * fine_Hz[j];
  }
  result.refined_Hz = weighted / result.mac;
  // At the nodes of the coarse mesh fine modes are not quite orthogonal.
  result.mac = std::min(result.mac, 1.0);
  result.error = result.mac < kSameMode
                     ? kUnknown
                     : error_over_change * std::abs(coarse_Hz / result.refined_Hz - 1);
  return result;
}

/// A finer mesh, and what the change that it makes is multiplied with.
struct FinerMesh {
  mesher::Mesh mesh;
  double error_over_change;
};

/// Whether all nodes of some part lie on the surface of the body.
bool has_thin_part(const mesher::Mesh& mesh) {
  std::vector<bool> is_outside(mesh.nodes.size(), false);
  for (const mesher::Facet& side : mesher::boundary_facets(mesh))
    for (const std::int32_t node : side.nodes) is_outside[static_cast<std::size_t>(node)] = true;
  std::map<std::string, bool> is_thin;
  for (const mesher::ElementBlock& block : mesh.blocks) {
    bool& thin = is_thin.try_emplace(block.part, true).first->second;
    thin = thin && std::all_of(block.nodes.begin(), block.nodes.end(), [&](std::int32_t node) {
             return is_outside[static_cast<std::size_t>(node)];
           });
  }
  return std::any_of(is_thin.begin(), is_thin.end(), [](const auto& part) { return part.second; });
}

/// Linear elements in bending stay as much too stiff when they are cut; quadratic ones tell by how
/// much. The warping of a square that twists vanishes in one of these, and shows in four.
/// @throws InputError where memory does not even hold the mesh.
FinerMesh finer_mesh(const mesher::Mesh& mesh, int mode_count) {
  const bool has_linear = std::any_of(
      mesh.blocks.begin(), mesh.blocks.end(),
      [](const mesher::ElementBlock& block) { return mesher::order_of(block.kind) == 1; });
  if (!has_linear) return {mesher::refine(mesh).mesh, kOfCut};
  mesher::Mesh raised = mesher::raise_order(mesh).mesh;
  if (has_thin_part(mesh)) {
    const double dofs = 3 * kCutInEight * static_cast<double>(raised.nodes.size());
    require_memory("the mesh's error, estimated with " + std::to_string(std::llround(dofs)) +
                       " degrees of freedom, as its elements are linear,",
                   memory_needs(dofs, mode_count).assembling,
                   "take quadratic elements, or leave out modes.check");
    raised = mesher::refine(raised).mesh;
  }
  return {std::move(raised), kOfRaised};
}

/// The modal assurance criteria (coarse, fine) of modes of a finer mesh, in the coarse mass.
Eigen::MatrixXd similarity(const AssembledSystem& coarse, const EigenPairs& pairs,
                           const Model& model, const EigenPairs& fine) {
  // The nodes of the coarse mesh come first.
  std::vector<Eigen::Matrix3Xd> fields = model.fields().expand(fine.vectors);
  for (Eigen::Matrix3Xd& field : fields)
    field = field.leftCols(coarse.fields().node_count()).eval();
  const Eigen::MatrixXd seen = coarse.fields().restrict(fields);
  const Eigen::MatrixXd momentum = block_product(coarse.mass(), seen);
  const Eigen::ArrayXd norms = column_products(coarse.ranks(), seen, momentum);
  const Eigen::ArrayXXd products = inner_products(coarse.ranks(), pairs.vectors, momentum).array();
  return products.square().rowwise() / norms.transpose();
}

}  // namespace

std::vector<MeshError> mesh_errors(const AssembledSystem& system, const EigenPairs& pairs,
                                   const Progress& progress) {
  // Rigid-body motions are the same on every mesh.
  std::vector<MeshError> errors(static_cast<std::size_t>(pairs.values.size()), {0, 1, 0});
  if (pairs.values.isZero(0)) return errors;
  const FinerMesh finer = finer_mesh(system.model().mesh(), system.model().options().mode_count);
  ModalOptions options = system.model().options();
  options.element_ranks.clear();
  options.node_order.clear();
  options.prestress_m.resize(3, 0);
  Model model(finer.mesh, std::move(options));
  if (progress)
    progress("refining for the error of the mesh, " + std::to_string(model.dof_map().dof_count()) +
             " degrees of freedom");
  add_prestress(model, progress);
  const AssembledSystem fine(model);
  const Eigen::MatrixXd rigid = fine.rigid_modes();
  const std::unique_ptr<const LinearSolver> inverse = shift_inverse(fine, shift_of(model));
  const Eigen::Index elastic = pairs.values.size() - rigid.cols();
  const Eigen::Index most = std::min(kMost * elastic, size_of(fine.mass()) - rigid.cols());
  for (Eigen::Index count = std::min(elastic + kMore, most);; count = std::min(2 * count, most)) {
    const EigenPairs found = lowest_eigenpairs(fine.mass(), *inverse, count, rigid);
    const Eigen::MatrixXd shared = similarity(system, pairs, model, found);
    const Eigen::VectorXd fine_Hz = found.values.unaryExpr(&hertz);
    bool is_one_lost = false;
    for (Eigen::Index k = 0; k < pairs.values.size(); ++k) {
      if (pairs.values[k] == 0) continue;
      MeshError& error = errors[static_cast<std::size_t>(k)];
      error = compare(hertz(pairs.values[k]), fine_Hz, shared.row(k), finer.error_over_change);
      is_one_lost |= error.mac < kSameMode;
    }
    if (!is_one_lost || count == most) return errors;
  }
}

}  // namespace flexneck::fe_modal
