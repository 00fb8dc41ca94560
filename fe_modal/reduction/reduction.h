// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "fe_modal/body/basis_kind.h"
#include "fe_modal/body/modal_body.h"
#include "fe_modal/reduction/operators.h"
#include "fe_modal/reduction/static_shapes.h"
#include "fe_modal/solve/eigensolver.h"
#include "geometry/foundation/progress.h"

namespace flexneck::fe_modal {

struct Reduction {
  EigenPairs pairs;                ///< M-orthonormal, ascending
  std::vector<std::string> kinds;  ///< kind of each pair, see basis_kind.h
  /// For each interface; empty for a body whose modes do not contain all its rigid motions.
  std::vector<StaticResponse> responses;
};

/// Solver for the lowest eigenpairs of K x = lambda M x for any symmetric positive M.
using ModeSolver = std::function<EigenPairs(Mat mass, Eigen::Index count)>;

/// Completes the eigenvectors of a body by the static shapes of its interfaces: residual attachment
/// modes (MacNeal, Comput. Struct. 1 (1971); Rubin, AIAA J. 13 (1975)), for a free body with
/// inertia relief. Each has a frequency and is M-orthonormal to all others. Shapes that depend on
/// others or that the modes already contain are dropped and reported.
/// @param normal eigenpairs of the body; eigenvalues of rigid motions are exactly zero
/// @param kind kind of the basis; normal adds no shapes
/// @param rigid_count number of rigid motions that the supports leave the body
/// @throws InputError if a free body's basis lacks rigid motions; ComputationError from the solver.
Reduction complete_modes(const BodyOperators& body, const EigenPairs& normal,
                         const std::vector<InterfaceLoads>& interfaces, BasisKind kind,
                         Eigen::Index rigid_count, const Progress& progress);

/// Computes modes with the average motions of the interfaces fixed, and the interfaces' static
/// shapes (Craig and Bampton, AIAA J. 6 (1968)), made orthonormal by the reduced eigenproblem. The
/// `count` lowest of its vectors, perhaps none, represent modes, the others are corrections.
/// @pre the body is fixed
Reduction craig_bampton(const BodyOperators& body, Mat mass, const ModeSolver& solve_modes,
                        Eigen::Index count, const std::vector<InterfaceLoads>& interfaces,
                        const Progress& progress);

}  // namespace flexneck::fe_modal
