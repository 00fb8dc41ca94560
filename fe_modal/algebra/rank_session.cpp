// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/algebra/rank_session.h"

#include <chrono>
#include <cstdlib>
#include <thread>

#include "fe_modal/algebra/communicator.h"

namespace flexneck::fe_modal {
namespace {

using Clock = std::chrono::steady_clock;
/// Time within which ranks that fail for the same reason do so.
constexpr std::chrono::seconds kPatience{3};
constexpr std::chrono::milliseconds kNap{2};

/// Waits for all ranks without keeping the processor busy; a rank that has failed waits only
/// kPatience.
/// @return true if all have come
bool all_come(const Ranks& ranks, bool has_failed) {
  MPI_Request request = MPI_REQUEST_NULL;
  require_mpi(MPI_Ibarrier(communicator(ranks), &request));
  const auto end = Clock::now() + kPatience;
  for (;;) {
    int is_complete = 0;
    require_mpi(MPI_Test(&request, &is_complete, MPI_STATUS_IGNORE));
    if (is_complete != 0) return true;
    if (has_failed && Clock::now() > end) return false;
    std::this_thread::sleep_for(kNap);
  }
}

}  // namespace

bool RankSession::is_launched() {
  // mpirun of Open MPI, and MPICH and other launchers that use PMI, set the number of processes.
  for (const char* const name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"}) {
    if (const char* const size = std::getenv(name)) return std::atoi(size) > 1;
  }
  return std::getenv("PMIX_RANK") != nullptr;  // srun and other launchers that use PMIx
}

int RankSession::end(const RankOutcome& outcome, const Progress& tell) const {
  const bool has_failed = !outcome.failure.empty();
  const std::string who = ranks_.is_first() ? "" : "rank " + std::to_string(ranks_.own()) + ": ";
  if (ranks_.are_many() && !all_come(ranks_, has_failed)) {
    tell("rank " + std::to_string(ranks_.own()) + ": " + outcome.failure);
    MPI_Abort(communicator(ranks_), outcome.exit_code);
    std::abort();  // MPI_Abort does not return
  }
  int first = has_failed ? ranks_.own() : ranks_.count();
  if (ranks_.are_many())
    require_mpi(MPI_Allreduce(MPI_IN_PLACE, &first, 1, MPI_INT, MPI_MIN, communicator(ranks_)));
  if (first == ranks_.own()) tell(who + outcome.failure);
  int code = outcome.exit_code;
  if (ranks_.are_many())
    require_mpi(
        MPI_Bcast(&code, 1, MPI_INT, first == ranks_.count() ? 0 : first, communicator(ranks_)));
  return code;
}

}  // namespace flexneck::fe_modal
