// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/partition/metis.h"

#include "geometry/foundation/error.h"

namespace flexneck::mesher {

MetisOptions metis_options() {
  MetisOptions options{};
  METIS_SetDefaultOptions(options.data());
  options[METIS_OPTION_NUMBERING] = 0;
  options[METIS_OPTION_SEED] = 1;
  return options;
}

void require_metis(int status, const std::string& doing) {
  if (status == METIS_OK) return;
  const char* const why = status == METIS_ERROR_MEMORY  ? "out of memory"
                          : status == METIS_ERROR_INPUT ? "invalid input"
                                                        : "internal error";
  throw ComputationError("METIS, " + doing + ": " + why);
}

}  // namespace flexneck::mesher
