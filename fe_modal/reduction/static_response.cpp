// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/reduction/static_response.h"

#include "fe_modal/algebra/conjugate_gradients.h"
#include "fe_modal/algebra/matrix_product.h"

namespace flexneck::fe_modal {
namespace {

Eigen::VectorXd modal_energy(const Ranks& ranks, const EigenPairs& kept,
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
  // Modes come back by rounding.
  const auto precondition = [&](Eigen::MatrixXd residual) {
    remove_modes(body.ranks, momenta, modes, residual);
    Eigen::MatrixXd response = body.precondition(residual);
    remove_modes(body.ranks, modes, momenta, response);
    return response;
  };
  Eigen::MatrixXd rest = loads;
  remove_modes(body.ranks, momenta, modes, rest);
  return conjugate_gradients(body.ranks, body.stiffness, precondition, rest,
                             modal_energy(body.ranks, kept, loads));
}

}  // namespace flexneck::fe_modal
