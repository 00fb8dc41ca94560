// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string_view>
#include <utility>

#include <Eigen/Core>
#include <slepceps.h>

#include "fe_modal/algebra/ranks.h"

namespace flexneck::fe_modal {

/// Turns an error code of PETSc or SLEPc into an exception.
/// @param doing the attempted action, e.g. "assembling the stiffness matrix"
/// @throws ComputationError if the code is not zero.
void require(PetscErrorCode code, std::string_view doing);

/// Owns one PETSc object: move-only, destroyed with the handle. Must not outlive the session.
template <typename Object, PetscErrorCode (*destroy)(Object*)>
class PetscHandle {
 public:
  PetscHandle() = default;
  ~PetscHandle() { reset(); }
  PetscHandle(const PetscHandle&) = delete;
  PetscHandle& operator=(const PetscHandle&) = delete;
  PetscHandle(PetscHandle&& other) noexcept : object_(std::exchange(other.object_, nullptr)) {}
  PetscHandle& operator=(PetscHandle&& other) noexcept {
    if (this != &other) {
      reset();
      object_ = std::exchange(other.object_, nullptr);
    }
    return *this;
  }

  Object get() const { return object_; }
  /// Frees the present object and returns a place for a new one, for functions that create it.
  Object* out() {
    reset();
    return &object_;
  }

 private:
  void reset() {
    // A caller could do nothing about a failing destructor of PETSc.
    if (object_ != nullptr) static_cast<void>(destroy(&object_));
    object_ = nullptr;
  }

  Object object_ = nullptr;
};

using MatHandle = PetscHandle<Mat, MatDestroy>;
using IsHandle = PetscHandle<IS, ISDestroy>;
using VecHandle = PetscHandle<Vec, VecDestroy>;
using EpsHandle = PetscHandle<EPS, EPSDestroy>;
using KspHandle = PetscHandle<KSP, KSPDestroy>;

/// Distributed vector on this rank's rows in memory that outlives it.
VecHandle vector_on(std::span<const double> values, const Ranks& ranks = {});
/// Vector on a column of a matrix that outlives it.
VecHandle column_vector(const Eigen::MatrixXd& columns, Eigen::Index column,
                        const Ranks& ranks = {});
/// Dense matrix on this rank's rows, (own rows, k), in memory that outlives it.
MatHandle dense_on(const Eigen::MatrixXd& columns, const Ranks& ranks = {});

/// INFOG(number) as in the user's guide of MUMPS, of a factor that MUMPS has computed.
PetscInt infog(Mat factor, PetscInt number);

/// Number of rows, over all ranks.
Eigen::Index size_of(Mat matrix);
/// Product of the matrix, or operator, with each column: this rank's rows, (own rows, k).
Eigen::MatrixXd block_product(Mat matrix, const Eigen::MatrixXd& columns);

}  // namespace flexneck::fe_modal
