// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/analysis/slit_basis.h"

#include "fe_modal/analysis/attached_frequencies.h"
#include "fe_modal/body/independent_loads.h"
#include "fe_modal/reduction/ritz.h"
#include "fe_modal/reduction/static_response.h"
#include "fe_modal/solve/make_system.h"
#include "geometry/foundation/error.h"

namespace flexneck::fe_modal {
namespace {

Eigen::MatrixXd all_loads(const std::vector<InterfaceLoads>& loads) {
  Eigen::MatrixXd all(loads.front().forces.rows(), static_cast<Eigen::Index>(6 * loads.size()));
  for (std::size_t k = 0; k < loads.size(); ++k)
    all.middleCols<6>(static_cast<Eigen::Index>(6 * k)) = loads[k].forces;
  return all;
}

/// The body with its slits shut, whose nodes are those of the open one.
class ShutBody {
 public:
  ShutBody(mesher::Mesh mesh, const DofMap& open, const ModalOptions& options)
      : mesh_(tied(std::move(mesh))),
        open_(open),
        dof_map_(dof_map_of(mesh_, options)),
        system_(make_system(mesh_, dof_map_, options)),
        inverse_(system_->shift_inverse(0)) {}

  /// Static shapes under loads on the open body, both by the open body's degrees of freedom.
  Eigen::MatrixXd shapes(const Eigen::MatrixXd& loads) const {
    Eigen::MatrixXd own(dof_map_.dof_count(), loads.cols());
    for (Eigen::Index k = 0; k < loads.cols(); ++k)
      own.col(k) = dof_map_.gather(open_.expand(loads.col(k)));
    own = static_response_beyond(operators_of(*system_, *inverse_), {}, own);
    Eigen::MatrixXd result(loads.rows(), loads.cols());
    for (Eigen::Index k = 0; k < loads.cols(); ++k)
      result.col(k) = open_.restrict(dof_map_.expand(own.col(k)));
    return result;
  }

 private:
  static mesher::Mesh tied(mesher::Mesh mesh) {
    for (mesher::Slit& slit : mesh.slits) slit.tied = true;
    return mesh;
  }

  mesher::Mesh mesh_;
  const DofMap& open_;
  DofMap dof_map_;
  std::unique_ptr<const ModalSystem> system_;
  std::unique_ptr<const ShiftInverse> inverse_;
};

}  // namespace

SlitBasis slit_basis(const mesher::Mesh& mesh, const DofMap& dof_map, const BodyOperators& open,
                     const ModalOptions& options, const std::vector<InterfaceLoads>& loads,
                     const Progress& progress) {
  // Forces on couplings and in fixed directions do not pass from the one body to the other.
  if (dof_map.is_constrained())
    throw InputError(
        "slits that open and close: expected no rigid interface and no direction fixed alone");
  const Eigen::MatrixXd forces = all_loads(loads);
  const Eigen::MatrixXd responses = static_response_beyond(open, {}, forces);
  const Eigen::MatrixXd compliance = forces.transpose() * responses;
  const Eigen::MatrixXd mass = responses.transpose() * open.mass(responses);
  const IndependentLoads independent = independent_loads(compliance, compliance.diagonal());

  SlitBasis basis;
  basis.fields = slit_fields(mesh, expanded(dof_map, responses * independent.combinations),
                             options.slit_motions == SlitMotions::openings_and_sliding);
  if (progress)
    progress(std::to_string(basis.fields.size()) + " ways in which slits part join the basis");
  Eigen::MatrixXd jumps(forces.rows(), static_cast<Eigen::Index>(basis.fields.size()));
  for (std::size_t k = 0; k < basis.fields.size(); ++k)
    jumps.col(static_cast<Eigen::Index>(k)) = dof_map.restrict(on_nodes(mesh, basis.fields[k]));

  const ShutBody shut(mesh, dof_map, options);
  Eigen::MatrixXd vectors(forces.rows(), independent.combinations.cols() + jumps.cols());
  vectors << shut.shapes(forces * independent.combinations),
      jumps - shut.shapes(open.stiffness(jumps));
  basis.reduction.pairs = ritz_pairs(open, Eigen::MatrixXd(), std::move(vectors));
  basis.reduction.kinds.assign(static_cast<std::size_t>(basis.reduction.pairs.values.size()),
                               std::string(kConstraintMode));
  for (Eigen::Index first = 0; first < compliance.rows(); first += 6) {
    const Matrix6d block = compliance.block<6, 6>(first, first);
    basis.reduction.responses.push_back(
        {(block + block.transpose()) / 2, mass.block<6, 6>(first, first)});
  }
  return basis;
}

}  // namespace flexneck::fe_modal
