// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/algebra/ranks.h"

#include <array>
#include <chrono>
#include <exception>
#include <filesystem>
#include <limits>
#include <new>
#include <string>
#include <thread>

#include "fe_modal/algebra/communicator.h"
#include "geometry/foundation/available_memory.h"
#include "geometry/foundation/error.h"
#include "geometry/foundation/path_error.h"

namespace flexneck::fe_modal {
namespace {

constexpr std::chrono::microseconds kNap{200};

enum class Kind { computation, input, memory };

struct RankFailure {
  std::string text;  ///< empty if nothing has failed
  Kind kind = Kind::computation;
};

RankFailure failure_of(const std::function<void()>& work) {
  try {
    work();
    return {};
  } catch (const InputError& error) {
    return {error.what(), Kind::input};
  } catch (const std::filesystem::filesystem_error& error) {
    return {text_of(error), is_of_path(error) ? Kind::input : Kind::computation};
  } catch (const OutOfMemory& error) {
    return {error.what(), Kind::memory};
  } catch (const std::bad_alloc&) {
    return {current_failure(), Kind::memory};
  } catch (...) {
    return {current_failure()};
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
    return "an unknown error";
  }
}

void require_mpi(int code) {
  if (code == MPI_SUCCESS) return;
  std::array<char, MPI_MAX_ERROR_STRING> text{};
  int length = 0;
  const bool is_known = MPI_Error_string(code, text.data(), &length) == MPI_SUCCESS;
  throw ComputationError("MPI failed: " +
                         (is_known ? std::string(text.data(), static_cast<std::size_t>(length))
                                   : "code " + std::to_string(code)));
}

Ranks Ranks::all() {
  Ranks ranks;
  require_mpi(MPI_Comm_rank(MPI_COMM_WORLD, &ranks.own_));
  require_mpi(MPI_Comm_size(MPI_COMM_WORLD, &ranks.count_));
  return ranks;
}

int Ranks::on_this_machine() const {
  if (!are_many()) return 1;
  MPI_Comm beside = MPI_COMM_NULL;
  require_mpi(
      MPI_Comm_split_type(communicator(*this), MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &beside));
  int count = 1;
  require_mpi(MPI_Comm_size(beside, &count));
  require_mpi(MPI_Comm_free(&beside));
  return count;
}

void Ranks::sum(Eigen::Ref<Eigen::MatrixXd> values) const {
  if (!are_many()) return;
  Eigen::MatrixXd sums = values;  // copy without gaps between columns
  // MPI_Allreduce is not used: it need not add in the same order on all ranks.
  const auto size = static_cast<int>(sums.size());
  require_mpi(MPI_Reduce(is_first() ? MPI_IN_PLACE : sums.data(), sums.data(), size, MPI_DOUBLE,
                         MPI_SUM, 0, communicator(*this)));
  require_mpi(MPI_Bcast(sums.data(), size, MPI_DOUBLE, 0, communicator(*this)));
  values = sums;
}

double Ranks::sum(double value) const {
  Eigen::MatrixXd sums = Eigen::MatrixXd::Constant(1, 1, value);
  sum(sums);
  return sums(0, 0);
}

std::uint64_t Ranks::of_first(std::uint64_t value) const {
  if (!are_many()) return value;
  MPI_Request request = MPI_REQUEST_NULL;
  require_mpi(MPI_Ibcast(&value, 1, MPI_UINT64_T, 0, communicator(*this), &request));
  // The first rank may be busy for long: a rank that waits for it polls at intervals.
  for (int is_complete = 0; is_complete == 0;) {
    require_mpi(MPI_Test(&request, &is_complete, MPI_STATUS_IGNORE));
    if (is_complete == 0) std::this_thread::sleep_for(kNap);
  }
  require_mpi(MPI_Wait(&request, MPI_STATUS_IGNORE));  // returns at once
  return value;
}

void Ranks::together(const std::function<void()>& work) const {
  if (!are_many()) {
    work();
    return;
  }
  RankFailure failure = failure_of(work);
  const int own_failure = failure.text.empty() ? count_ : own_;
  int first = count_;
  require_mpi(MPI_Allreduce(&own_failure, &first, 1, MPI_INT, MPI_MIN, communicator(*this)));
  if (first == count_) return;
  int head[2] = {static_cast<int>(failure.text.size()), static_cast<int>(failure.kind)};
  require_mpi(MPI_Bcast(head, 2, MPI_INT, first, communicator(*this)));
  failure.text.resize(static_cast<std::size_t>(head[0]));
  require_mpi(MPI_Bcast(failure.text.data(), head[0], MPI_CHAR, first, communicator(*this)));
  if (head[1] == static_cast<int>(Kind::input)) throw InputError(failure.text);
  if (head[1] == static_cast<int>(Kind::memory)) throw OutOfMemory(failure.text);
  throw ComputationError(failure.text);
}

}  // namespace flexneck::fe_modal
