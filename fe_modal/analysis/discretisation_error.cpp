// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/analysis/discretisation_error.h"

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "fe_modal/algebra/block_product.h"
#include "fe_modal/algebra/matrix_product.h"
#include "fe_modal/analysis/prestress.h"
#include "fe_modal/solve/refined/refined_modes.h"
#include "fe_modal/solve/refined/refined_system.h"
#include "mesher/mesh/refinement.h"

namespace flexneck::fe_modal {
namespace {

/// Order of convergence of frequencies that no mesh falls below: where rubber is bonded to a plate
/// and ends at a right angle, stresses grow as r^(a - 1), a = 0.59 for nu = 1/2 and more below, and
/// frequencies converge with h^(2a).
constexpr double kLowestOrder = 1;
/// For meshes so coarse that they do not show their order yet (Roache, J. Fluids Eng. 116 (1994)
/// 405, multiplies likewise): a 20-node mesh of two elements through bonded rubber needs 1.25.
constexpr double kSafety = 1.5;
/// Modes this close in frequency may turn into one another from mesh to mesh: they are one shape.
constexpr double kOneShape = 1e-2;
/// Less similar shapes are not the same mode, and nothing is known of the error.
constexpr double kSameMode = 0.8;
constexpr double kUnknown = 1;

double hertz(double eigenvalue) {
  return std::sqrt(std::max(eigenvalue, 0.0)) / (2 * std::numbers::pi);
}

/// Matrices of stars, which are summed up and factorised, leave gaps in the heap. SuperLU_DIST,
/// which PETSc is linked with, has the allocator keep all that is freed, and large blocks in the
/// heap too.
void give_free_memory_back() {
#ifdef __GLIBC__
  ::malloc_trim(0);
#endif
}

/// What is farther from each coarse eigenvalue: the finer mode's upper bound, or that less what it
/// may be above the eigenvalue.
Eigen::VectorXd farthest(const Eigen::VectorXd& coarse, const RefinedModes& refined) {
  const Eigen::VectorXd lower = refined.values - refined.excess;
  return ((lower - coarse).array().abs() > (refined.values - coarse).array().abs())
      .select(lower, refined.values);
}

/// Finds a coarse mode among the finer ones.
/// @param similarity its modal assurance criterion with each of them
MeshError compare(double coarse_Hz, const Eigen::VectorXd& fine_Hz,
                  const Eigen::VectorXd& similarity) {
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
  const double change = std::abs(coarse_Hz - result.refined_Hz);
  result.error = result.mac < kSameMode
                     ? kUnknown
                     : kSafety * change / (1 - std::exp2(-kLowestOrder)) / coarse_Hz;
  return result;
}

/// Modal assurance criteria (coarse, fine) in the mass of the coarse mesh, whose nodes come first.
Eigen::MatrixXd similarities(const SolvedMesh& coarse, const FieldMap& fine_nodes,
                             const Eigen::MatrixXd& fine) {
  const FieldMap& coarse_nodes = coarse.system.fields();
  const Ranks& ranks = coarse_nodes.ranks();
  std::vector<Eigen::Matrix3Xd> fields = fine_nodes.expand(fine);
  for (Eigen::Matrix3Xd& field : fields) field = field.leftCols(coarse_nodes.node_count()).eval();
  const Eigen::MatrixXd seen = coarse_nodes.restrict(fields);
  const Eigen::MatrixXd momentum = block_product(coarse.system.mass(), seen);
  const Eigen::ArrayXd norms = column_products(ranks, seen, momentum);
  const Eigen::ArrayXXd products = inner_products(ranks, coarse.pairs.vectors, momentum).array();
  return products.square().rowwise() / norms.transpose();
}

}  // namespace

std::vector<MeshError> mesh_errors(const SolvedMesh& solved, const ModalOptions& options,
                                   const Progress& progress) {
  const mesher::RefinedMesh fine = mesher::refine(solved.mesh);
  const DofMap dof_map = dof_map_of(fine.mesh, options);
  if (progress) {
    progress("refining for the error of the mesh, " + std::to_string(dof_map.dof_count()) +
             " degrees of freedom");
  }
  ModalOptions fine_options = options;
  fine_options.element_ranks.clear();
  fine_options.node_order.clear();
  fine_options = with_prestress(fine.mesh, std::move(fine_options), progress);
  const RefinedSystem system(solved.system, solved.inverse, fine, dof_map, fine_options);
  give_free_memory_back();
  const RefinedModes refined = refined_modes(system, solved.pairs, solved.rigid_count);

  const Eigen::MatrixXd similarity = similarities(solved, system.fields(), refined.vectors);
  const Eigen::VectorXd fine_Hz = farthest(solved.pairs.values, refined).unaryExpr(&hertz);
  std::vector<MeshError> errors;
  for (Eigen::Index k = 0; k < similarity.rows(); ++k) {
    const double coarse_Hz = hertz(solved.pairs.values[k]);
    // Rigid-body motions are the same on every mesh.
    errors.push_back(coarse_Hz == 0 ? MeshError{0, 1, 0}
                                    : compare(coarse_Hz, fine_Hz, similarity.row(k)));
  }
  return errors;
}

}  // namespace flexneck::fe_modal
