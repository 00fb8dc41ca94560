// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/analysis/prestress.h"

#include <algorithm>
#include <numbers>
#include <utility>

#include <Eigen/Eigenvalues>

#include "fe_modal/analysis/static_analysis.h"
#include "fe_modal/element/element_fields.h"
#include "fe_modal/solve/assembled_system.h"
#include "fe_modal/solve/eigensolver.h"
#include "fe_modal/system/assembly.h"
#include "geometry/foundation/error.h"
#include "geometry/foundation/output_file.h"

namespace flexneck::fe_modal {
namespace {

/// Largest buckling factor that is reported: the eigenvalues 1 / factor of a body in tension come
/// as near to zero as the mesh allows, and no iteration distinguishes them from zero.
constexpr double kLargestFactor = 1000;

/// Options of a serial run: each rank solves the static problem by itself, since all need its
/// displacements.
ModalOptions alone(ModalOptions options) {
  options.ranks = {};
  options.element_ranks.clear();
  return options;
}

ModalOptions without_prestress(ModalOptions options) {
  options.prestress_m.resize(3, 0);
  return options;
}

[[noreturn]] void refuse_buckled(double factor) {
  throw InputError("the body buckles under its prestress at " + rounded_text(factor, 4) +
                   " times the loads; reduce the loads");
}

}  // namespace

void add_prestress(Model& model, const Progress& progress) {
  const ModalOptions& options = model.options();
  if (options.prestress.empty()) return;
  const Model alone_model(model.mesh(), alone(without_prestress(options)));
  model.set_prestress(static_step(alone_model, options.prestress, progress).displacements_m);
}

std::string large_prestress_text(const Model& model) {
  const ModalOptions& options = model.options();
  if (options.prestress_m.cols() == 0) return {};
  constexpr double kLargestStrain = 0.1;
  constexpr double kLargestTurn_rad = 0.3;
  double strain = 0;
  double turn_rad = 0;
  for_each_element(
      model.mesh(), options.formulation, {&options.prestress_m}, [&](const ElementState& state) {
        for (Eigen::Index q = 0; q < state.fields.volumes_m3.size(); ++q) {
          Eigen::Matrix3d gradient;
          for (Eigen::Index k = 0; k < 9; ++k)
            gradient(k / 3, k % 3) = state.fields.gradients[static_cast<std::size_t>(k)](0, q);
          const Eigen::Matrix3d half_skew = (gradient - gradient.transpose()) / 2;
          turn_rad = std::max(turn_rad, half_skew.norm() / std::numbers::sqrt2);
          if (gradient.norm() <= strain) continue;
          const Eigen::Vector3d strains =
              Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>((gradient + gradient.transpose()) / 2,
                                                             Eigen::EigenvaluesOnly)
                  .eigenvalues();
          strain = std::max(strain, strains.cwiseAbs().maxCoeff());
        }
      });
  if (strain <= kLargestStrain && turn_rad <= kLargestTurn_rad) return {};
  return "the static step of the prestress causes strains of up to " + rounded_text(strain, 2) +
         " and rotations of up to " + rounded_text(turn_rad * 180 / std::numbers::pi, 2) +
         " deg; above a strain of 0.1 or about 20 deg, small-displacement theory has errors of 10 "
         "% or more; reduce the loads";
}

std::optional<double> buckling_factor(const Model& model) {
  const Model body(model.mesh(), alone(without_prestress(model.options())));
  const MatHandle compression = assemble_geometric(
      body.mesh(), body.dof_map(), body.options().formulation, model.options().prestress_m, -1);
  const AssembledSystem system(body);
  const double value =
      largest_eigenvalue(compression.get(), *shift_inverse(system, 0), 1 / kLargestFactor);
  if (!(value * kLargestFactor > 1)) return std::nullopt;
  return 1 / value;
}

std::unique_ptr<const LinearSolver> factorise_prestressed(const AssembledSystem& system) {
  try {
    return shift_inverse(system, 0);
  } catch (const NotDefinite&) {
    const std::optional<double> factor = buckling_factor(system.model());
    if (factor && *factor <= 1) refuse_buckled(*factor);
    throw;
  }
}

std::string prestress_text(const ModalOptions& options) {
  std::string text;
  for (const Load& load : options.prestress) text += (text.empty() ? "" : "; ") + describe(load);
  return text;
}

}  // namespace flexneck::fe_modal
