// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/reliability/fuzz/input_folder.h"

#include <cstdio>
#include <cstdlib>
#include <fstream>

namespace flexneck::fuzz {

std::filesystem::path InputFolder::with(const std::string& name,
                                        const std::string& contents) const {
  std::filesystem::path path = folder_ / name;
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  file << contents;
  file.close();
  if (!file) throw ComputationError(path.string() + ": cannot be written");
  return path;
}

void require(bool holds, const std::string& what) {
  if (holds) return;
  std::fprintf(stderr, "does not hold: %s\n", what.c_str());
  std::abort();
}

}  // namespace flexneck::fuzz
