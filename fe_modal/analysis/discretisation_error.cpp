// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/analysis/discretisation_error.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "fe_modal/algebra/matrix_product.h"
#include "fe_modal/analysis/prestress.h"
#include "fe_modal/solve/eigensolver.h"
#include "fe_modal/solve/mechanism.h"
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
/// Modes of the finer mesh beyond those of the coarse one, with which they may change places.
constexpr Eigen::Index kMore = 2;

double hertz(double eigenvalue) {
  return std::sqrt(std::max(eigenvalue, 0.0)) / (2 * std::numbers::pi);
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

/// The modes of the finer mesh, and what each shares with the coarse ones.
struct FineModes {
  Eigen::VectorXd frequencies_Hz;
  Eigen::MatrixXd similarity;  ///< modal assurance criteria (coarse, fine), in the coarse mass
};

FineModes fine_modes(const AssembledSystem& coarse, const EigenPairs& pairs, const Model& model) {
  const AssembledSystem system(model);
  const Eigen::MatrixXd rigid = system.rigid_modes();
  const std::unique_ptr<const LinearSolver> inverse = shift_inverse(system, shift_of(model));
  const Eigen::Index elastic =
      std::min(pairs.values.size() + kMore, size_of(system.mass())) - rigid.cols();
  const EigenPairs fine = lowest_eigenpairs(system.mass(), *inverse, elastic, rigid);

  // The nodes of the coarse mesh come first.
  std::vector<Eigen::Matrix3Xd> fields = model.fields().expand(fine.vectors);
  for (Eigen::Matrix3Xd& field : fields)
    field = field.leftCols(coarse.fields().node_count()).eval();
  const Eigen::MatrixXd seen = coarse.fields().restrict(fields);
  const Eigen::MatrixXd momentum = block_product(coarse.mass(), seen);
  const Eigen::ArrayXd norms = column_products(coarse.ranks(), seen, momentum);
  const Eigen::ArrayXXd products = inner_products(coarse.ranks(), pairs.vectors, momentum).array();
  return {fine.values.unaryExpr(&hertz), products.square().rowwise() / norms.transpose()};
}

}  // namespace

std::vector<MeshError> mesh_errors(const AssembledSystem& system, const EigenPairs& pairs,
                                   const Progress& progress) {
  // Rigid-body motions are the same on every mesh.
  std::vector<MeshError> errors(static_cast<std::size_t>(pairs.values.size()), {0, 1, 0});
  if (pairs.values.isZero(0)) return errors;
  const mesher::RefinedMesh fine = mesher::refine(system.model().mesh());
  ModalOptions options = system.model().options();
  options.element_ranks.clear();
  options.node_order.clear();
  options.prestress_m.resize(3, 0);
  Model model(fine.mesh, std::move(options));
  if (progress)
    progress("refining for the error of the mesh, " + std::to_string(model.dof_map().dof_count()) +
             " degrees of freedom");
  add_prestress(model, progress);
  const FineModes found = fine_modes(system, pairs, model);
  for (Eigen::Index k = 0; k < pairs.values.size(); ++k) {
    if (pairs.values[k] == 0) continue;
    errors[static_cast<std::size_t>(k)] =
        compare(hertz(pairs.values[k]), found.frequencies_Hz, found.similarity.row(k));
  }
  return errors;
}

}  // namespace flexneck::fe_modal
