// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdio>

#include "tests/benchmarks/simbody_chain.h"

namespace flexneck::benchmarks {

void report_simbody_chain(int /*runs*/) {
  std::printf("rigid chain in Simbody: not run, libsimbody-dev was not there at configuration\n");
}

}  // namespace flexneck::benchmarks
