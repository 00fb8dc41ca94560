// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/reduction/static_response.h"

#include "fe_modal/algebra/communicator.h"
#include "fe_modal/algebra/matrix_product.h"
#include "fe_modal/algebra/operator_matrix.h"
#include "geometry/foundation/error.h"

namespace flexneck::fe_modal {
namespace {

constexpr const char* kSolving = "solving for static shapes";
/// Largest error of a static shape in the energy norm, relative.
constexpr double kTolerance = 1e-10;

/// Solves K x = f for each column by conjugate gradients; K may be singular if f has no component
/// in its null space.
/// @param within  largest energy norm of the error of each column
Eigen::MatrixXd conjugate_gradients(const Ranks& ranks, const BlockOperator& stiffness,
                                    const BlockOperator& precondition, const Eigen::MatrixXd& loads,
                                    const Eigen::VectorXd& within) {
  const OperatorMatrix matrix(loads.rows(), stiffness, ranks);
  const OperatorMatrix preconditioner(loads.rows(), precondition, ranks);
  KspHandle solver;
  require(KSPCreate(communicator(ranks), solver.out()), kSolving);
  require(KSPSetOperators(solver.get(), matrix.get(), preconditioner.get()), kSolving);
  require(KSPSetType(solver.get(), KSPCG), kSolving);
  require(KSPSetNormType(solver.get(), KSP_NORM_NATURAL), kSolving);
  PC multiplies = nullptr;
  require(KSPGetPC(solver.get(), &multiplies), kSolving);
  require(PCSetType(multiplies, PCMAT), kSolving);
  Eigen::MatrixXd shapes = Eigen::MatrixXd::Zero(loads.rows(), loads.cols());
  for (Eigen::Index k = 0; k < loads.cols(); ++k) {
    const VecHandle load = column_vector(loads, k, ranks);
    const VecHandle shape = column_vector(shapes, k, ranks);
    require(KSPSetTolerances(solver.get(), 0, within[k], PETSC_DEFAULT, PETSC_DEFAULT), kSolving);
    const PetscErrorCode code = KSPSolve(solver.get(), load.get(), shape.get());
    rethrow_from(preconditioner.get());
    require(code, kSolving);
    KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
    require(KSPGetConvergedReason(solver.get(), &reason), kSolving);
    if (reason < 0)
      throw ComputationError("the linear solver did not converge for a static shape of the body");
  }
  return shapes;
}

Eigen::VectorXd modal_energies(const Ranks& ranks, const EigenPairs& kept,
                               const Eigen::MatrixXd& loads) {
  if (kept.vectors.cols() == 0) return Eigen::VectorXd::Zero(loads.cols());
  return modal_response(kept.values, inner_products(ranks, kept.vectors, loads))
      .compliance.diagonal();
}

}  // namespace

ModalResponse modal_response(const Eigen::VectorXd& values, const Eigen::MatrixXd& modal_loads) {
  const Eigen::VectorXd flexibility =
      (values.array() > 0).select(values.array().inverse(), 0).matrix();
  ModalResponse response;
  response.amplitudes = flexibility.asDiagonal() * modal_loads;
  response.compliance = modal_loads.transpose() * response.amplitudes;
  response.mass = response.amplitudes.transpose() * response.amplitudes;
  return response;
}

void remove_modes(const Ranks& ranks, const Eigen::MatrixXd& modes, const Eigen::MatrixXd& momenta,
                  Eigen::MatrixXd& columns) {
  if (modes.cols() > 0) columns -= modes * inner_products(ranks, momenta, columns);
}

Eigen::MatrixXd static_response_beyond(const BodyOperators& body, const EigenPairs& kept,
                                       const Eigen::MatrixXd& loads) {
  const Eigen::MatrixXd& modes = kept.vectors;
  const Eigen::MatrixXd momenta = modes.cols() > 0 ? body.mass(modes) : modes;
  // Modes are removed after each solve too, since rounding brings them back.
  const auto solve = [&](Eigen::MatrixXd residual) {
    remove_modes(body.ranks, momenta, modes, residual);
    Eigen::MatrixXd response = body.solve(residual);
    remove_modes(body.ranks, modes, momenta, response);
    return response;
  };
  Eigen::MatrixXd rest = loads;
  remove_modes(body.ranks, momenta, modes, rest);
  // Two block solves suffice for a fixed body and exact modes: the second removes the rounding
  // errors of the first.
  Eigen::MatrixXd response = solve(rest);
  const Eigen::MatrixXd residual = rest - body.stiffness(response);
  const Eigen::MatrixXd correction = solve(residual);
  response += correction;
  const Eigen::VectorXd energies =
      modal_energies(body.ranks, kept, loads) + column_products(body.ranks, response, rest);
  const Eigen::VectorXd within = kTolerance * energies.cwiseMax(0).cwiseSqrt();
  const Eigen::ArrayXd left = column_products(body.ranks, correction, residual);
  if ((left <= within.array().square()).all()) return response;
  return response + conjugate_gradients(body.ranks, body.stiffness, solve,
                                        rest - body.stiffness(response), within);
}

}  // namespace flexneck::fe_modal
