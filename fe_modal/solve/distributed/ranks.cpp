// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/solve/distributed/ranks.h"

#include <cstdlib>
#include <exception>
#include <string>
#include <utility>

#include "fe_modal/solve/distributed/messages.h"
#include "fe_modal/solve/distributed/worker.h"
#include "geometry/foundation/error.h"

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

Ranks::Ranks(Progress last_words) : last_words_(std::move(last_words)) {
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &count_);
}

Ranks::~Ranks() {
  if (!is_leader()) return;
  try {
    for (int worker = 1; worker < count_; ++worker) send_order(MPI_COMM_WORLD, worker, {});
  } catch (...) {
    end_all();
  }
}

void Ranks::serve() const {
  try {
    Worker(MPI_COMM_WORLD).run();
  } catch (...) {
    end_all();
  }
}

void Ranks::in_step(const std::function<void()>& work) const {
  try {
    work();
  } catch (const ComputationError&) {
    throw;
  } catch (...) {
    end_all();
  }
}

void Ranks::end_all() const noexcept {
  try {
    if (last_words_) last_words_("rank " + std::to_string(rank_) + ": " + current_failure());
  } catch (...) {
    // Nothing is left to say it with, and the others must not wait.
  }
  MPI_Abort(MPI_COMM_WORLD, kFailed);
  std::abort();  // MPI_Abort does not return
}

}  // namespace flexneck::fe_modal
