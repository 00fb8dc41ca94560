// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <mpi.h>

#include "fe_modal/algebra/ranks.h"

namespace flexneck::fe_modal {

/// World communicator, or self in a serial run.
inline MPI_Comm communicator(const Ranks& ranks) {
  return ranks.are_many() ? MPI_COMM_WORLD : MPI_COMM_SELF;
}

/// Checks the code that a call of MPI returned.
/// @throws ComputationError if the call has failed and MPI has not ended the process itself.
void require_mpi(int code);

}  // namespace flexneck::fe_modal
