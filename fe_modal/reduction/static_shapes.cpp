// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/reduction/static_shapes.h"

#include "fe_modal/algebra/matrix_product.h"
#include "fe_modal/body/independent_loads.h"
#include "fe_modal/reduction/static_response.h"

namespace flexneck::fe_modal {
namespace {

/// The modes' part of the static shapes. The stiffness couples inexact modes with the remaining
/// shapes; with this coupling in the compliance, its error is of second order in those of the
/// modes.
ModalResponse modal_part(const BodyOperators& body, const EigenPairs& kept,
                         const StaticShapes& shapes) {
  const Eigen::Index count = shapes.loads.cols();
  if (kept.values.size() == 0) {
    return {{}, Eigen::MatrixXd::Zero(count, count), Eigen::MatrixXd::Zero(count, count)};
  }
  ModalResponse modal =
      modal_response(kept.values, inner_products(body.ranks, kept.vectors, shapes.loads));
  const Eigen::MatrixXd stiffness =
      inner_products(body.ranks, kept.vectors, body.stiffness(shapes.beyond));
  const Eigen::MatrixXd coupled = modal.amplitudes.transpose() * stiffness;
  modal.compliance -= coupled + coupled.transpose();
  return modal;
}

}  // namespace

InterfaceLoads interface_loads(const std::string& name, const RigidAverage& average,
                               const FieldMap& field_map) {
  return {name, field_map.gather(average.weights(field_map.node_count()))};
}

StaticShapes static_shapes(const BodyOperators& body, const EigenPairs& kept,
                           const std::vector<InterfaceLoads>& interfaces) {
  StaticShapes shapes;
  const auto count = static_cast<Eigen::Index>(6 * interfaces.size());
  shapes.loads.resize(interfaces.front().forces.rows(), count);
  for (std::size_t k = 0; k < interfaces.size(); ++k) {
    shapes.loads.middleCols<6>(static_cast<Eigen::Index>(6 * k)) = interfaces[k].forces;
  }
  shapes.beyond = static_response_beyond(body, kept, shapes.loads);
  shapes.rest = inner_products(body.ranks, shapes.loads, shapes.beyond);
  const Eigen::MatrixXd rest_mass =
      inner_products(body.ranks, shapes.beyond, body.mass(shapes.beyond));
  const ModalResponse modal = modal_part(body, kept, shapes);
  const Eigen::MatrixXd compliance = modal.compliance + shapes.rest;
  const Eigen::MatrixXd mass = modal.mass + rest_mass;
  shapes.compliance = compliance.diagonal();
  for (Eigen::Index first = 0; first < count; first += 6) {
    const Matrix6d block = compliance.block<6, 6>(first, first);
    shapes.responses.push_back({(block + block.transpose()) / 2, mass.block<6, 6>(first, first)});
  }
  return shapes;
}

Eigen::MatrixXd correcting_loads(const StaticShapes& shapes,
                                 const std::vector<InterfaceLoads>& interfaces,
                                 const Progress& progress) {
  std::vector<Eigen::Index> chosen;
  for (std::size_t k = 0; k < interfaces.size(); ++k) {
    if (!interfaces[k].corrects_basis) continue;
    for (std::size_t i = 0; i < 6; ++i) chosen.push_back(static_cast<Eigen::Index>(6 * k + i));
  }
  const IndependentLoads independent =
      independent_loads(shapes.rest(chosen, chosen), shapes.compliance(chosen));
  if (independent.dropped > 0 && progress) {
    progress(std::to_string(independent.dropped) + " of " + std::to_string(chosen.size()) +
             " correction modes are dropped, since the other basis vectors contain them");
  }
  const auto count = static_cast<Eigen::Index>(chosen.size());
  Eigen::MatrixXd combinations =
      Eigen::MatrixXd::Zero(shapes.rest.rows(), independent.combinations.cols());
  for (Eigen::Index i = 0; i < count; ++i) {
    combinations.row(chosen[static_cast<std::size_t>(i)]) = independent.combinations.row(i);
  }
  return combinations;
}

}  // namespace flexneck::fe_modal
