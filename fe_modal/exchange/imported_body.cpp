// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/exchange/imported_body.h"

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "fe_modal/algebra/petsc_choices.h"
#include "fe_modal/reduction/invariants.h"
#include "fe_modal/reduction/mode_conventions.h"
#include "fe_modal/reduction/mode_naming.h"
#include "fe_modal/solve/eigensolver.h"
#include "fe_modal/solve/sturm_check.h"
#include "geometry/foundation/error.h"

namespace flexneck::fe_modal {
namespace {

constexpr const char* kWrapping = "importing a matrix";
constexpr double kSameInEachDirection = 1e-12;

/// Wraps the arrays of a matrix, which PETSc reads in place.
MatHandle wrap(const UpperMatrix& upper) {
  MatHandle matrix;
  const auto size = static_cast<PetscInt>(upper.rows());
  require(MatCreateSeqSBAIJWithArrays(PETSC_COMM_SELF, 1, size, size,
                                      const_cast<PetscInt*>(upper.outerIndexPtr()),
                                      const_cast<PetscInt*>(upper.innerIndexPtr()),
                                      const_cast<PetscScalar*>(upper.valuePtr()), matrix.out()),
          kWrapping);
  require(MatSetOption(matrix.get(), MAT_SPD, PETSC_TRUE), kWrapping);
  return matrix;
}

/// Mass between nodes, in one direction, from that of all degrees of freedom.
NodalMass nodal_mass_of(const UpperMatrix& mass) {
  std::vector<Eigen::Triplet<double, std::int32_t>> entries;
  for (Eigen::Index row = 0; row < mass.rows(); row += 3) {
    for (UpperMatrix::InnerIterator entry(mass, row); entry; ++entry) {
      if (entry.col() % 3 != 0) continue;
      const auto i = static_cast<std::int32_t>(row / 3);
      const auto j = static_cast<std::int32_t>(entry.col() / 3);
      entries.emplace_back(i, j, entry.value());
      if (i != j) entries.emplace_back(j, i, entry.value());
    }
  }
  NodalMass nodal(mass.rows() / 3, mass.rows() / 3);
  nodal.setFromTriplets(entries.begin(), entries.end());
  return nodal;
}

class ImportedSystem : public ModalSystem {
 public:
  ImportedSystem(const ImportedBody& body, Solver solver)
      : solver_(solver),
        stiffness_(wrap(body.stiffness)),
        mass_(wrap(body.mass)),
        nodal_mass_(nodal_mass_of(body.mass)) {}

  Mat stiffness() const override { return stiffness_.get(); }
  Mat mass() const override { return mass_.get(); }
  const NodalMass& nodal_mass() const { return nodal_mass_; }
  const Ranks& ranks() const override { return alone_; }
  Solver solver() const override { return solver_; }

 private:
  Ranks alone_;
  Solver solver_;
  MatHandle stiffness_;
  MatHandle mass_;
  NodalMass nodal_mass_;
};

double largest_entry(const UpperMatrix& matrix) {
  double largest = 0;
  for (Eigen::Index k = 0; k < matrix.nonZeros(); ++k) {
    largest = std::max(largest, std::abs(matrix.valuePtr()[k]));
  }
  return largest;
}

std::vector<std::array<double, 3>> positions_of(const ImportedBody& body) {
  std::vector<std::array<double, 3>> positions;
  for (const auto& node : body.nodes_m.colwise()) positions.push_back({node[0], node[1], node[2]});
  return positions;
}

}  // namespace

UpperMatrix expand_mass(const NodalMass& nodal) {
  std::vector<Eigen::Triplet<double, std::int32_t>> entries;
  for (Eigen::Index row = 0; row < nodal.rows(); ++row) {
    for (NodalMass::InnerIterator entry(nodal, row); entry; ++entry) {
      if (entry.col() < row) continue;
      for (Eigen::Index a = 0; a < 3; ++a) {
        entries.emplace_back(static_cast<std::int32_t>(3 * row + a),
                             static_cast<std::int32_t>(3 * entry.col() + a), entry.value());
      }
    }
  }
  UpperMatrix mass(3 * nodal.rows(), 3 * nodal.rows());
  mass.setFromTriplets(entries.begin(), entries.end());
  return mass;
}

void check(const ImportedBody& body) {
  const Eigen::Index size = 3 * body.nodes_m.cols();
  for (const UpperMatrix* const matrix : {&body.stiffness, &body.mass}) {
    if (matrix->rows() != size || size == 0) {
      throw InputError("stiffness and mass must have three rows for each of the " +
                       std::to_string(body.nodes_m.cols()) + " nodes, found " +
                       std::to_string(matrix->rows()));
    }
  }
  const UpperMatrix difference = body.mass - expand_mass(nodal_mass_of(body.mass));
  if (largest_entry(difference) > kSameInEachDirection * largest_entry(body.mass)) {
    throw InputError(
        "expected a mass matrix with equal entries in the three directions, as solid elements "
        "have; beams, shells and constraints are not supported");
  }
}

ModalBody analyse_matrices(const ImportedBody& input, const ModalOptions& options,
                           const Progress& progress, const Progress& warn) {
  const PetscChoices choices(options.petsc_options);
  check(input);
  const int mode_count = options.mode_count;
  if (mode_count < 1 || mode_count > input.stiffness.rows()) {
    throw InputError("the number of modes must lie between 1 and the " +
                     std::to_string(input.stiffness.rows()) + " degrees of freedom, found " +
                     std::to_string(mode_count));
  }
  if (progress) progress("factorising the given stiffness matrix");
  const ImportedSystem system(input, options.solver);
  const std::unique_ptr<const LinearSolver> inverse = shift_inverse(system, 0);
  auto [pairs, completeness] = lowest_modes(system, *inverse, mode_count, {}, options.check, warn);
  check_eigenvalues(pairs.values, 0);
  apply_conventions(pairs, DofLayout(input.nodes_m.cols()));

  ModalBody body;
  body.frequencies_Hz = pairs.values.cwiseMax(0).cwiseSqrt() / (2 * std::numbers::pi);
  body.boundary = "fixed: as in the matrices";
  body.completeness = completeness;
  body.solver = inverse->describe();
  body.nodes_m = input.nodes_m;
  for (const auto& vector : pairs.vectors.colwise()) {
    body.shapes.push_back(vector.reshaped(3, input.nodes_m.cols()));
  }
  const std::vector<std::string> names =
      mode_names(std::vector<Shares>(static_cast<std::size_t>(mode_count)));
  const Eigen::VectorXd residuals =
      relative_residuals(system.stiffness(), system.mass(), *inverse, pairs);
  for (Eigen::Index k = 0; k < pairs.values.size(); ++k) {
    body.modes.push_back({names[static_cast<std::size_t>(k)], "normal", {}, residuals[k]});
  }
  body.invariants = inertia_invariants(system.nodal_mass(), positions_of(input), body.shapes);
  body.orthogonality = (body.invariants.Maa - Eigen::MatrixXd::Identity(mode_count, mode_count))
                           .cwiseAbs()
                           .maxCoeff();
  choices.require_used();
  return body;
}

}  // namespace flexneck::fe_modal
