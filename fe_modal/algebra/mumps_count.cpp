// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/algebra/mumps_count.h"

#include <algorithm>
#include <dmumps_c.h>
#include <string>
#include <vector>

#include "fe_modal/algebra/communicator.h"
#include "geometry/foundation/available_memory.h"
#include "geometry/foundation/error.h"

namespace flexneck::fe_modal {
namespace {

// Job numbers and control parameters of the MUMPS user's guide, counted from 1 there.
constexpr int kBegin = -1;
constexpr int kEnd = -2;
constexpr int kAnalyse = 1;
constexpr int kFactorise = 2;

constexpr int kRelaxation = 14;  ///< workspace beyond the estimate, per cent
constexpr int kFirstRelaxation = 10;
constexpr int kMaxRelaxation = 200;

bool wants_more_workspace(int status) {
  return status == -8 || status == -9 || status == -14 || status == -15 || status == -17 ||
         status == -20;
}

bool wants_memory(int status) { return status == -5 || status == -7 || status == -13; }

/// Entries of a part by row and column of the whole matrix, from 1.
struct Coordinates {
  std::vector<MUMPS_INT> rows;
  std::vector<MUMPS_INT> columns;
};

Coordinates coordinates_of(const SymmetricMatrix& part, std::span<const std::int32_t> blocks) {
  const auto global = [&](PetscInt dof) {
    return 3 * blocks[static_cast<std::size_t>(dof / 3)] + dof % 3 + 1;
  };
  Coordinates result;
  const auto offsets = part.offsets();
  const auto columns = part.columns();
  result.rows.reserve(columns.size());
  result.columns.reserve(columns.size());
  for (PetscInt row = 0; row < part.size(); ++row) {
    const auto begin = static_cast<std::size_t>(offsets[static_cast<std::size_t>(row)]);
    const auto end = static_cast<std::size_t>(offsets[static_cast<std::size_t>(row) + 1]);
    result.rows.insert(result.rows.end(), end - begin, global(row));
    for (const PetscInt column : columns.subspan(begin, end - begin)) {
      result.columns.push_back(global(column));
    }
  }
  return result;
}

/// When each degree of freedom is eliminated, from 1.
std::vector<MUMPS_INT> places(std::span<const std::int32_t> order) {
  std::vector<MUMPS_INT> result(3 * order.size());
  MUMPS_INT place = 0;
  for (const std::int32_t block : order) {
    for (std::size_t a = 0; a < 3; ++a) result[3 * static_cast<std::size_t>(block) + a] = ++place;
  }
  return result;
}

/// Of MUMPS, ended with its scope.
struct Instance {
  DMUMPS_STRUC_C data{};

  explicit Instance(const Ranks& ranks) {
    data.comm_fortran = static_cast<MUMPS_INT>(MPI_Comm_c2f(communicator(ranks)));
    data.par = 1;
    data.sym = 2;  // with pivoting
    run(kBegin, "starting");
    set(1, -1);  // no output
    set(2, -1);
    set(3, -1);
    set(4, 0);
    set(6, 0);    // no maximum transversal
    set(7, 1);    // the order of elimination is given
    set(8, 0);    // no scaling
    set(12, 1);   // no compressed ordering
    set(15, -3);  // three degrees of freedom a node: the analysis sees the graph of the nodes
    set(18, 3);   // parts of the matrix on all ranks
    set(13, 1);   // a root by ScaLAPACK would not count its negative pivots
    set(24, 1);   // finds null pivots
  }
  ~Instance() {
    data.job = kEnd;
    dmumps_c(&data);
  }
  Instance(const Instance&) = delete;
  Instance& operator=(const Instance&) = delete;

  void set(int control, int value) { data.icntl[control - 1] = value; }
  int status() const { return data.infog[0]; }
  int negative_pivots() const { return data.infog[11]; }

  void call(int job) {
    data.job = job;
    dmumps_c(&data);
  }
  void run(int job, const std::string& doing) {
    call(job);
    require_success(doing);
  }
  void require_success(const std::string& doing) const {
    if (status() >= 0) return;
    if (wants_memory(status()))
      throw out_of_memory(doing + " with MUMPS", "take a coarser mesh, or leave out modes.certify");
    throw ComputationError("MUMPS failed while " + doing + ": error " + std::to_string(status()) +
                           ", " + std::to_string(data.infog[1]));
  }

  void factorise() {
    for (int relaxation = kFirstRelaxation; relaxation <= kMaxRelaxation; relaxation *= 2) {
      set(kRelaxation, relaxation);
      call(kFactorise);
      if (!wants_more_workspace(status())) break;
    }
    require_success("factorising the matrix");
    if (data.infog[27] > 0) {
      throw ComputationError("an eigenvalue lies where the inertia was to be taken; take another");
    }
  }
};

}  // namespace

Eigen::Index count_with_pivoting(const DofLayout& layout, SymmetricMatrix& part,
                                 std::span<const std::int32_t> blocks,
                                 std::span<const std::int32_t> order) {
  const Ranks& ranks = layout.ranks();
  Instance instance(ranks);
  DMUMPS_STRUC_C& data = instance.data;
  Coordinates coordinates;
  std::vector<MUMPS_INT> places_of_rows;
  ranks.together([&] {
    coordinates = coordinates_of(part, blocks);
    if (ranks.is_first()) places_of_rows = places(order);
  });
  data.n = static_cast<MUMPS_INT>(layout.dof_count());
  data.perm_in = places_of_rows.data();
  data.nnz_loc = static_cast<MUMPS_INT8>(coordinates.rows.size());
  data.irn_loc = coordinates.rows.data();
  data.jcn_loc = coordinates.columns.data();
  data.a_loc = part.values().data();
  instance.run(kAnalyse, "analysing the matrix");
  const int beside = ranks.on_this_machine();
  ranks.together([&] {
    constexpr std::size_t kMegabytes = 14;  // of this rank
    require_memory("counting modes by inertia with pivoting", 1e6 * beside * data.info[kMegabytes],
                   "take a coarser mesh, or leave out modes.certify");
  });
  instance.factorise();
  return instance.negative_pivots();
}

}  // namespace flexneck::fe_modal
