// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/algebra/petsc_handles.h"

#include <string>

#include "fe_modal/algebra/communicator.h"
#include "fe_modal/algebra/operator_matrix.h"
#include "fe_modal/algebra/petsc_session.h"
#include "geometry/foundation/available_memory.h"
#include "geometry/foundation/error.h"

namespace flexneck::fe_modal {

void require(PetscErrorCode code, std::string_view doing) {
  if (code == 0) return;
  const std::string told = last_petsc_message();
  const std::string text = "PETSc failed while " + std::string(doing) + ": " +
                           (told.empty() ? "unknown error" : told) + " (code " +
                           std::to_string(static_cast<int>(code)) + ")";
  if (code == PETSC_ERR_MEM)
    throw out_of_memory(std::string(doing),
                        "use a coarser mesh, or the solver mumps on several ranks");
  throw ComputationError(text);
}

VecHandle vector_on(std::span<const double> values, const Ranks& ranks) {
  VecHandle vector;
  const auto size = static_cast<PetscInt>(values.size());
  require(ranks.are_many()
              ? VecCreateMPIWithArray(communicator(ranks), 1, size, PETSC_DECIDE, values.data(),
                                      vector.out())
              : VecCreateSeqWithArray(communicator(ranks), 1, size, values.data(), vector.out()),
          "creating a vector");
  return vector;
}

VecHandle column_vector(const Eigen::MatrixXd& columns, Eigen::Index column, const Ranks& ranks) {
  const auto rows = static_cast<std::size_t>(columns.rows());
  return vector_on({columns.data() + column * columns.rows(), rows}, ranks);
}

MatHandle dense_on(const Eigen::MatrixXd& columns, const Ranks& ranks) {
  MatHandle matrix;
  require(MatCreateDense(communicator(ranks), static_cast<PetscInt>(columns.rows()), PETSC_DECIDE,
                         PETSC_DETERMINE, static_cast<PetscInt>(columns.cols()),
                         const_cast<double*>(columns.data()), matrix.out()),
          "creating a matrix");
  return matrix;
}

PetscInt infog(Mat factor, PetscInt number) {
  PetscInt value = 0;
  require(MatMumpsGetInfog(factor, number, &value), "querying the status of MUMPS");
  return value;
}

Eigen::Index size_of(Mat matrix) {
  PetscInt size = 0;
  require(MatGetSize(matrix, &size, nullptr), "querying the size of a matrix");
  return size;
}

Eigen::MatrixXd block_product(Mat matrix, const Eigen::MatrixXd& columns) {
  if (const BlockOperator* const apply = operator_behind(matrix)) return (*apply)(columns);
  int ranks = 1;
  require_mpi(MPI_Comm_size(PetscObjectComm(reinterpret_cast<PetscObject>(matrix)), &ranks));
  const Ranks among = ranks > 1 ? Ranks::all() : Ranks();
  Eigen::MatrixXd result(columns.rows(), columns.cols());
  for (Eigen::Index k = 0; k < columns.cols(); ++k) {
    const VecHandle x = column_vector(columns, k, among);
    const VecHandle y = column_vector(result, k, among);
    require(MatMult(matrix, x.get(), y.get()), "multiplying by a matrix");
  }
  return result;
}

}  // namespace flexneck::fe_modal
