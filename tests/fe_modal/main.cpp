// SPDX-License-Identifier: GPL-3.0-or-later
#define CATCH_CONFIG_RUNNER
#include <catch2/catch.hpp>

#include "fe_modal/modal_analysis.h"

int main(int argc, char* argv[]) {
  const flexneck::fe_modal::PetscSession session;
  return Catch::Session().run(argc, argv);
}
