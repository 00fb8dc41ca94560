// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/reduction/static_response.h"

#include <string>

#include "geometry/foundation/error.h"

namespace flexneck::fe_modal {
namespace {

/// Squares of errors in the energy norm, relative to the whole response.
constexpr double kAimed = 1e-28;
constexpr double kAccepted = 1e-20;
/// Rounding has been reached when a step gains less than this.
constexpr double kGain = 0.25;
constexpr int kMostSteps = 200;

Eigen::ArrayXd column_products(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return a.cwiseProduct(b).colwise().sum().transpose().array();
}

/// a / b, and zero where b is.
Eigen::ArrayXd ratio(const Eigen::ArrayXd& a, const Eigen::ArrayXd& b) {
  return (b > 0).select(a / b, 0);
}

Eigen::ArrayXd modal_energy(const EigenPairs& kept, const Eigen::MatrixXd& loads) {
  if (kept.vectors.cols() == 0) return Eigen::ArrayXd::Zero(loads.cols());
  return modal_response(kept.values, kept.vectors.transpose() * loads)
      .compliance.diagonal()
      .array();
}

}  // namespace

ModalResponse modal_response(const Eigen::VectorXd& values, const Eigen::MatrixXd& modal_loads) {
  const Eigen::VectorXd flexibility =
      (values.array() > 0).select(values.array().inverse(), 0).matrix();
  const Eigen::MatrixXd amplitudes = flexibility.asDiagonal() * modal_loads;
  return {modal_loads.transpose() * amplitudes, amplitudes.transpose() * amplitudes};
}

void remove_modes(const Eigen::MatrixXd& modes, const Eigen::MatrixXd& momenta,
                  Eigen::MatrixXd& columns) {
  if (modes.cols() > 0) columns -= modes * (momenta.transpose() * columns).eval();
}

Eigen::MatrixXd static_response_beyond(const BodyOperators& body, const EigenPairs& kept,
                                       const Eigen::MatrixXd& loads) {
  const Eigen::MatrixXd& modes = kept.vectors;
  const Eigen::MatrixXd momenta = modes.cols() > 0 ? body.mass(modes) : modes;
  const auto precondition = [&](const Eigen::MatrixXd& residual) {
    Eigen::MatrixXd response = body.solve(residual);
    remove_modes(modes, momenta, response);
    return response;
  };
  Eigen::MatrixXd residual = loads;
  remove_modes(momenta, modes, residual);
  Eigen::MatrixXd correction = precondition(residual);
  Eigen::MatrixXd direction = correction;
  Eigen::ArrayXd energy = column_products(residual, correction);
  const Eigen::ArrayXd whole = energy + modal_energy(kept, loads);
  Eigen::MatrixXd response = Eigen::MatrixXd::Zero(loads.rows(), loads.cols());
  for (int step = 0; step < kMostSteps; ++step) {
    const Eigen::MatrixXd force = body.stiffness(direction);
    const Eigen::ArrayXd length = ratio(energy, column_products(direction, force));
    response += direction * length.matrix().asDiagonal();
    residual -= force * length.matrix().asDiagonal();
    remove_modes(momenta, modes, residual);
    correction = precondition(residual);
    const Eigen::ArrayXd next = column_products(residual, correction).max(0);
    const bool small = (next <= kAimed * whole).all();
    const bool stalled = (next <= kAccepted * whole).all() && (next >= kGain * energy).any();
    if (small || stalled) {
      response += correction;  // nothing is left but this
      remove_modes(modes, momenta, response);
      return response;
    }
    direction = correction + direction * ratio(next, energy).matrix().asDiagonal();
    energy = next;
  }
  throw ComputationError("the static response to interface loads has not converged after " +
                         std::to_string(kMostSteps) +
                         " steps: the stiffness is too badly conditioned");
}

}  // namespace flexneck::fe_modal
