// SPDX-License-Identifier: GPL-3.0-or-later
#define CATCH_CONFIG_EXTERNAL_INTERFACES
#include <optional>

#include <catch2/catch.hpp>

#include "fe_modal/modal_analysis.h"

namespace {

/// PETSc is there while tests run.
class SessionOfRun : public Catch::TestEventListenerBase {
 public:
  using TestEventListenerBase::TestEventListenerBase;
  void testRunStarting(const Catch::TestRunInfo&) override { session_.emplace(); }
  void testRunEnded(const Catch::TestRunStats&) override { session_.reset(); }

 private:
  std::optional<flexneck::fe_modal::PetscSession> session_;
};

CATCH_REGISTER_LISTENER(SessionOfRun)

}  // namespace
