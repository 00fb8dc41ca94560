// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/solve/distributed/messages.h"

#include <chrono>
#include <exception>
#include <limits>
#include <new>
#include <thread>

#include "geometry/foundation/error.h"

namespace flexneck::fe_modal {
namespace {

constexpr int kTag = 1;
/// Within a computation messages come sooner than this …
constexpr std::chrono::milliseconds kPatience{20};
/// … and who waits longer looks at times only.
constexpr std::chrono::milliseconds kNap{1};

std::string failure_of(const std::function<void()>& work) {
  try {
    work();
    return {};
  } catch (...) {
    return current_failure();
  }
}

}  // namespace

std::string current_failure() {
  try {
    throw;
  } catch (const std::bad_alloc&) {
    return "out of memory";
  } catch (const std::exception& error) {
    return error.what();
  } catch (...) {
    return "an unknown failure";
  }
}

void send(MPI_Comm ranks, int to, const Bytes& bytes) {
  if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
    throw InputError("a rank's share is larger than a message; start more ranks");
  }
  MPI_Send(bytes.data(), static_cast<int>(bytes.size()), MPI_BYTE, to, kTag, ranks);
}

Bytes receive(MPI_Comm ranks, int from) {
  const auto start = std::chrono::steady_clock::now();
  int has_come = 0;
  MPI_Status status;
  for (;;) {
    MPI_Iprobe(from, kTag, ranks, &has_come, &status);
    if (has_come != 0) break;
    if (std::chrono::steady_clock::now() - start > kPatience) std::this_thread::sleep_for(kNap);
  }
  int size = 0;
  MPI_Get_count(&status, MPI_BYTE, &size);
  Bytes bytes(static_cast<std::size_t>(size));
  MPI_Recv(bytes.data(), size, MPI_BYTE, from, kTag, ranks, MPI_STATUS_IGNORE);
  return bytes;
}

void together(MPI_Comm ranks, const std::function<void()>& work) {
  int rank = 0;
  int count = 0;
  MPI_Comm_rank(ranks, &rank);
  MPI_Comm_size(ranks, &count);
  std::string failure = failure_of(work);
  const int own = failure.empty() ? count : rank;
  int first = count;
  MPI_Allreduce(&own, &first, 1, MPI_INT, MPI_MIN, ranks);
  if (first == count) return;
  int length = static_cast<int>(failure.size());
  MPI_Bcast(&length, 1, MPI_INT, first, ranks);
  failure.resize(static_cast<std::size_t>(length));
  MPI_Bcast(failure.data(), length, MPI_CHAR, first, ranks);
  throw ComputationError(failure);
}

}  // namespace flexneck::fe_modal
