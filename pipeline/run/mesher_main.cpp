// SPDX-License-Identifier: GPL-3.0-or-later
// flexneck-mesher: the program that flexneck starts to mesh with gmsh.
#include <cstdio>
#include <span>

#include "pipeline/process/child_main.h"
#include "pipeline/process/console.h"
#include "pipeline/run/mesh_task.h"

namespace {

constexpr int kUnusableInput = 2;

}  // namespace

int main(int argc, char** argv) {
  using namespace flexneck::pipeline;
  prepare_process();
  const std::span<char*> words(argv, static_cast<std::size_t>(argc));
  if (is_child(words)) child_main(words, {{"mesh", mesh_task}});
  std::fputs("flexneck-mesher: flexneck starts this program; see 'flexneck mesh --help'\n", stderr);
  return kUnusableInput;
}
