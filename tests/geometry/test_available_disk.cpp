// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "geometry/foundation/available_disk.h"
#include "geometry/foundation/error.h"
#include "geometry/foundation/temporary_folder.h"

using Catch::Matchers::Contains;
using namespace flexneck;

TEST_CASE("what does not fit onto the disk is refused with what it takes and what there is") {
  const TemporaryFolder folder;
  CHECK(available_disk(folder.path()) > 0);
  CHECK(available_disk("") > 0);
  CHECK_NOTHROW(require_disk(folder.path(), "a little", 1, "do"));
  CHECK_THROWS_AS(require_disk(folder.path(), "a lot", 1e20, "take less"), InputError);
  CHECK_THROWS_WITH(
      require_disk(folder.path(), "a lot", 1e20, "take less"),
      Contains(folder.path().string() + ": a lot needs about 1e+11 GB of disk space") &&
          Contains("are free; take less"));
}
