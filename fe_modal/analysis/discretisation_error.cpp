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

/// Ratio of the estimated error to the relative change that a finer mesh makes.
///
/// With every element cut in eight the error becomes 2^-p of its value, so that it is 1 / (1 -
/// 2^-p) of the change: at most two with the order p = 1 that singular edges leave at worst. A
/// safety factor of 1.5 is for meshes so coarse that they do not show their order yet (Roache, J.
/// Fluids Eng. 116 (1994) 405, uses such a factor as well).
constexpr double kOfCut = 1.5 * 2;
/// This ratio for quadratic elements in place of linear ones, which leave a part of the error.
constexpr double kOfRaised = 1.5;
/// Relative difference of frequencies below which modes may mix differently on different meshes:
/// they count as one shape. Rounding sets those of a square beam 1600 times as long as thick 1.2 %
/// apart.
constexpr double kOneShape = 2e-2;
/// Modal assurance criterion below which shapes are not the same mode, and the error is unknown.
constexpr double kSameMode = 0.8;
constexpr double kUnknown = 1;
/// Number of modes of the finer mesh beyond those of the coarse one, with which they may change
/// places.
constexpr Eigen::Index kMore = 2;
constexpr double kCutInEight = 8;
/// Largest ratio of the number of fine modes to that of coarse ones, for a mode that changes places
/// with many.
constexpr Eigen::Index kMost = 8;

double hertz(double eigenvalue) {
  return std::sqrt(std::max(eigenvalue, 0.0)) / (2 * std::numbers::pi);
}

/// Compares a coarse mode with the finer ones that have its shape.
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
  // Fine modes are not quite orthogonal at the nodes of the coarse mesh.
  result.mac = std::min(result.mac, 1.0);
  result.error = result.mac < kSameMode
                     ? kUnknown
                     : error_over_change * std::abs(coarse_Hz / result.refined_Hz - 1);
  return result;
}

/// A finer mesh, and the factor from the change that it makes to the error.
struct FinerMesh {
  mesher::Mesh mesh;
  double error_over_change;
};

/// Returns whether all nodes of some part lie on the surface of the body.
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

/// Chooses the finer mesh. Linear elements in bending remain as much too stiff when they are cut;
/// quadratic ones in their place show by how much. The warping of a square in torsion vanishes in
/// one quadratic element, and shows in four.
/// @throws InputError if memory does not hold the mesh itself.
FinerMesh finer_mesh(const mesher::Mesh& mesh, int mode_count) {
  const bool has_linear = std::any_of(
      mesh.blocks.begin(), mesh.blocks.end(),
      [](const mesher::ElementBlock& block) { return mesher::order_of(block.kind) == 1; });
  if (!has_linear) return {mesher::refine(mesh).mesh, kOfCut};
  mesher::Mesh raised = mesher::raise_order(mesh).mesh;
  if (has_thin_part(mesh)) {
    const double dofs = 3 * kCutInEight * static_cast<double>(raised.nodes.size());
    require_memory(
        "the estimate of the discretisation error, with " + std::to_string(std::llround(dofs)) +
            " degrees of freedom (increased since the elements are linear),",
        memory_needs(dofs, mode_count).assembling, "use quadratic elements, or omit modes.check");
    raised = mesher::refine(raised).mesh;
  }
  return {std::move(raised), kOfRaised};
}

/// Modal assurance criteria (coarse, fine) with modes of a finer mesh, in the metric of the coarse
/// mass.
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
  // Rigid-body motions have no error: they are the same on every mesh.
  std::vector<MeshError> errors(static_cast<std::size_t>(pairs.values.size()), {0, 1, 0});
  if (pairs.values.isZero(0)) return errors;
  const FinerMesh finer = finer_mesh(system.model().mesh(), system.model().options().mode_count);
  ModalOptions options = system.model().options();
  options.element_ranks.clear();
  options.node_order.clear();
  options.prestress_m.resize(3, 0);
  Model model(finer.mesh, std::move(options));
  if (progress)
    progress("refining the mesh for the discretisation error, " +
             std::to_string(model.dof_map().dof_count()) + " degrees of freedom");
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
