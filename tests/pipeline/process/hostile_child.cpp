// SPDX-License-Identifier: GPL-3.0-or-later
// A program whose tasks behave like libraries on damaged files.
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <thread>
#include <unistd.h>
#include <vector>

#include "geometry/foundation/error.h"
#include "pipeline/process/child_main.h"

namespace {

using namespace flexneck;
using namespace flexneck::pipeline;
using Arguments = std::vector<std::string>;

void crash(const Arguments& /*none*/, const ChildLines& /*lines*/) {
  std::puts("reading \x1b[31msection 7");
  std::fflush(stdout);
  std::abort();
}

void compute(const Arguments& /*none*/, const ChildLines& /*lines*/) {
  volatile bool forever = true;
  while (forever) {
  }
}

/// Computes beyond the time limit that it had at first.
void compute_later(const Arguments& none, const ChildLines& lines) {
  limit_what_follows(2);
  compute(none, lines);
}

void sleep_on(const Arguments& /*none*/, const ChildLines& lines) {
  lines.detail(std::to_string(getpid()));
  while (true) std::this_thread::sleep_for(std::chrono::seconds(1));
}

void allocate(const Arguments& /*none*/, const ChildLines& /*lines*/) {
  std::vector<std::vector<char>> blocks;
  while (true) blocks.emplace_back(std::size_t{1} << 20U, 'x');
}

/// Uses one page of the stack per call, which must be kept since it is still needed after the call.
int depth_below(int depth, const volatile char* above) {
  volatile char page[4096] = {};
  page[0] = static_cast<char>(above[0] + 1);
  const int below = depth == 1 << 20 ? 0 : depth_below(depth + 1, page);
  return below + page[depth % 4096];
}

/// Uses 4 GB of stack, if available.
void recurse(const Arguments& /*none*/, const ChildLines& lines) {
  const char first = 0;
  lines.detail(std::to_string(depth_below(0, &first)));
}

/// Allocates 300 MB after the input has been read.
void allocate_later(const Arguments& /*none*/, const ChildLines& lines) {
  limit_what_follows(60);
  const std::vector<char> block(std::size_t{300} << 20U, 'x');
  lines.detail(std::to_string(block.back()));
}

void leave(const Arguments& /*none*/, const ChildLines& /*lines*/) { std::_Exit(1); }

void refuse(const Arguments& /*none*/, const ChildLines& /*lines*/) {
  throw InputError("bar.msh: it has\nno volume");
}

void fail(const Arguments& /*none*/, const ChildLines& /*lines*/) {
  throw std::runtime_error("the disk is full");
}

void crash_at_exit(const Arguments& /*none*/, const ChildLines& /*lines*/) {
  std::atexit([] { std::abort(); });
}

/// Prints arguments, environment and open files, as the child sees them.
void tell(const Arguments& arguments, const ChildLines& lines) {
  std::fputs("a line without an end", stdout);
  for (const std::string& argument : arguments) lines.detail("argument " + argument);
  for (char** variable = environ; *variable != nullptr; ++variable) lines.detail(*variable);
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd"))
    lines.detail("file " + entry.path().filename().string());
  lines.warning("a part is left out");
}

/// Starts a child of its own, which sleeps.
void have_child(const Arguments& /*none*/, const ChildLines& lines) {
  IsolatedTask task;
  task.name = "sleep";
  run_isolated(task, "/tmp", lines);
}

}  // namespace

int main(int argc, char** argv) {
  child_main({argv, static_cast<std::size_t>(argc)}, {{"crash", crash},
                                                      {"compute", compute},
                                                      {"compute later", compute_later},
                                                      {"sleep", sleep_on},
                                                      {"allocate", allocate},
                                                      {"allocate later", allocate_later},
                                                      {"recurse", recurse},
                                                      {"leave", leave},
                                                      {"refuse", refuse},
                                                      {"fail", fail},
                                                      {"crash at exit", crash_at_exit},
                                                      {"tell", tell},
                                                      {"have child", have_child}});
}
