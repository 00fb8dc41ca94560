// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string_view>
#include <utility>

#include <petscsf.h>
#include <slepceps.h>

#include "fe_modal/algebra/ranks.h"

namespace flexneck::fe_modal {

/// Turns an error code of PETSc or SLEPc into an exception.
/// @param doing what was attempted, e.g. "assembling the stiffness matrix"
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
  /// For functions that create the object: frees the present one.
  Object* out() {
    reset();
    return &object_;
  }

 private:
  void reset() {
    // A failing destructor of PETSc leaves nothing that a caller could do.
    if (object_ != nullptr) static_cast<void>(destroy(&object_));
    object_ = nullptr;
  }

  Object object_ = nullptr;
};

using MatHandle = PetscHandle<Mat, MatDestroy>;
using IsHandle = PetscHandle<IS, ISDestroy>;
using VecHandle = PetscHandle<Vec, VecDestroy>;
using EpsHandle = PetscHandle<EPS, EPSDestroy>;
using StarForest = PetscHandle<PetscSF, PetscSFDestroy>;

/// A vector of the ranks, of which this one has the rows on memory that outlives it.
VecHandle vector_on(std::span<const double> values, const Ranks& ranks = {});

}  // namespace flexneck::fe_modal
