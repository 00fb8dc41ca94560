// SPDX-License-Identifier: GPL-3.0-or-later
#define CATCH_CONFIG_EXTERNAL_INTERFACES
#include "fe_modal/algebra/petsc_session.h"

#include <cstdlib>
#include <optional>

#include <catch2/catch.hpp>
#include <petscsys.h>

#include "fe_modal/analysis/modal_analysis.h"

namespace {

/// Keeps PETSc initialised while tests run.
class SessionOfRun : public Catch::TestEventListenerBase {
 public:
  using Catch::TestEventListenerBase::TestEventListenerBase;
  void testRunStarting(const Catch::TestRunInfo&) override {
    setenv("PETSC_OPTIONS", "-mat_cholmod_nmethods 2", 1);
    session_.emplace();
  }
  void testRunEnded(const Catch::TestRunStats&) override { session_.reset(); }

 private:
  std::optional<flexneck::fe_modal::PetscSession> session_;
};

CATCH_REGISTER_LISTENER(SessionOfRun)

}  // namespace

TEST_CASE("options of PETSc in the user's environment do not reach the solvers") {
  PetscBool found = PETSC_TRUE;
  REQUIRE(PetscOptionsHasName(nullptr, nullptr, "-mat_cholmod_nmethods", &found) == 0);
  CHECK(found == PETSC_FALSE);
}
