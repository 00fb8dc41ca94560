// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/distributed/ranks.h"

#include <cstdlib>
#include <exception>

#include "fe_modal/distributed/worker.h"

namespace flexneck::fe_modal {
namespace {

constexpr int kFailed = 3;

}  // namespace

bool Ranks::are_many() {
  // Open MPI; MPICH and whatever starts processes by PMI.
  for (const char* const name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"}) {
    const char* const size = std::getenv(name);
    if (size != nullptr && std::atoi(size) > 1) return true;
  }
  return false;
}

Ranks::Ranks() {
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &count_);
}

Ranks::~Ranks() {
  if (!is_leader()) return;
  for (int worker = 1; worker < count_; ++worker) send_order(MPI_COMM_WORLD, worker, {});
}

void Ranks::serve() const {
  try {
    Worker(MPI_COMM_WORLD).run();
  } catch (const std::exception&) {
    // Rank 0 may be waiting for an answer that will not come.
    MPI_Abort(MPI_COMM_WORLD, kFailed);
  }
}

}  // namespace flexneck::fe_modal
