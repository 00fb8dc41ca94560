// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/algebra/ghost_exchange.h"

#include "fe_modal/algebra/communicator.h"

namespace flexneck::fe_modal {
namespace {

constexpr const char* kExchanging = "exchanging rows among the ranks";

/// Row-wise, as they travel: all columns of a row at once.
using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// So many numbers as one unit of a star forest. PETSc does not add a single one that has a type of
/// its own.
class Unit {
 public:
  explicit Unit(Eigen::Index columns) : is_own_(columns > 1) {
    if (!is_own_) return;
    require_mpi(MPI_Type_contiguous(static_cast<int>(columns), MPI_DOUBLE, &type_));
    require_mpi(MPI_Type_commit(&type_));
  }
  ~Unit() {
    if (is_own_) MPI_Type_free(&type_);
  }
  Unit(const Unit&) = delete;
  Unit& operator=(const Unit&) = delete;

  MPI_Datatype get() const { return type_; }

 private:
  bool is_own_;
  MPI_Datatype type_ = MPI_DOUBLE;
};

}  // namespace

std::vector<std::int32_t> rows_of(std::span<const std::int32_t> blocks) {
  std::vector<std::int32_t> rows;
  rows.reserve(3 * blocks.size());
  for (const std::int32_t block : blocks) {
    for (std::int32_t a = 0; a < 3; ++a) rows.push_back(3 * block + a);
  }
  return rows;
}

GhostExchange::GhostExchange(const DofLayout& layout, std::span<const std::int32_t> rows)
    : own_rows_(layout.own_dof_count()),
      local_rows_(static_cast<Eigen::Index>(rows.size())),
      is_trivial_(!layout.ranks().are_many()) {
  if (is_trivial_) return;
  std::vector<PetscSFNode> roots;
  roots.reserve(rows.size());
  for (const std::int32_t row : rows) {
    roots.push_back({layout.owner(row / 3), 3 * layout.place(row / 3) + row % 3});
  }
  require(PetscSFCreate(communicator(layout.ranks()), forest_.out()), kExchanging);
  require(PetscSFSetGraph(forest_.get(), static_cast<PetscInt>(own_rows_),
                          static_cast<PetscInt>(local_rows_), nullptr, PETSC_COPY_VALUES,
                          roots.data(), PETSC_COPY_VALUES),
          kExchanging);
  require(PetscSFSetUp(forest_.get()), kExchanging);
}

Eigen::MatrixXd GhostExchange::to_local(const Eigen::MatrixXd& own) const {
  if (is_trivial_) return own;
  if (own.cols() == 0) return Eigen::MatrixXd(local_rows_, 0);
  const Unit unit(own.cols());
  const Rows roots = own;
  Rows leaves = Rows::Zero(local_rows_, own.cols());
  require(PetscSFBcastBegin(forest_.get(), unit.get(), roots.data(), leaves.data(), MPI_REPLACE),
          kExchanging);
  require(PetscSFBcastEnd(forest_.get(), unit.get(), roots.data(), leaves.data(), MPI_REPLACE),
          kExchanging);
  return leaves;
}

Eigen::MatrixXd GhostExchange::sum_to_own(const Eigen::MatrixXd& local) const {
  if (is_trivial_) return local;
  if (local.cols() == 0) return Eigen::MatrixXd(own_rows_, 0);
  const Unit unit(local.cols());
  const Rows leaves = local;
  Rows roots = Rows::Zero(own_rows_, local.cols());
  require(PetscSFReduceBegin(forest_.get(), unit.get(), leaves.data(), roots.data(), MPI_SUM),
          kExchanging);
  require(PetscSFReduceEnd(forest_.get(), unit.get(), leaves.data(), roots.data(), MPI_SUM),
          kExchanging);
  return roots;
}

}  // namespace flexneck::fe_modal
