// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "fe_modal/algebra/nodal_mass.h"
#include "fe_modal/body/modal_body.h"
#include "fe_modal/exchange/matrix_file.h"
#include "fe_modal/system/modal_options.h"
#include "geometry/foundation/progress.h"

namespace flexneck::fe_modal {

/// A body from another program: matrices of n free nodes in place of a mesh. Degree of freedom 3 k
/// + a is direction a of node k; fixed degrees of freedom are left out.
struct ImportedBody {
  UpperMatrix stiffness;  ///< (3n, 3n), N/m
  UpperMatrix mass;       ///< (3n, 3n), kg
  Eigen::Matrix3Xd nodes_m;
};

/// Expands the mass between nodes to all degrees of freedom.
UpperMatrix expand_mass(const NodalMass& nodal);

/// Checks an imported body.
/// @throws InputError unless the sizes agree and the mass is the same in each direction, as for
/// solid elements: then the inertia invariants follow from it.
void check(const ImportedBody& body);

/// Computes normal modes of a fixed body, with its invariants; it has no interfaces.
/// @param options number of modes, check, solver and options of PETSc; all other options are for
/// meshes
/// @param warn takes a line if the number of modes cuts a cluster of equal frequencies; may be
/// empty
/// @throws InputError as check(), or for more modes than degrees of freedom.
/// @throws ComputationError if the stiffness is not positive definite, or the eigensolver fails.
ModalBody analyse_matrices(const ImportedBody& body, const ModalOptions& options,
                           const Progress& progress, const Progress& warn = {});

}  // namespace flexneck::fe_modal
