// SPDX-License-Identifier: GPL-3.0-or-later
// Time and memory of meshing, partitioning and ordering the neck, as the mesh grows. Each size runs
// in a process of its own, so that the memory is its own peak.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "mesher/partition/element_partition.h"
#include "mesher/partition/node_order.h"
#include "tests/support/neck_mesh.h"

namespace {

using namespace flexneck;

using Clock = std::chrono::steady_clock;

double seconds_between(Clock::time_point begin, Clock::time_point end) {
  return std::chrono::duration<double>(end - begin).count();
}

void measure(int refine) {
  const auto begin = Clock::now();
  geometry::NeckDivisions divisions;
  divisions.refine = refine;
  const mesher::Mesh mesh = testing::neck_mesh("C", divisions);
  const auto meshed = Clock::now();
  const mesher::ElementPartition partition = mesher::partition_elements(mesh, 8);
  const auto shared_out = Clock::now();
  const std::vector<std::int32_t> order = mesher::nested_dissection(mesh);
  const auto ordered = Clock::now();
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  std::printf("%9zu %9zu %8.2f %10.2f %7.2f %10.1f %7.2f\n", mesh.nodes.size(),
              partition.processes.size(), seconds_between(begin, meshed),
              seconds_between(meshed, shared_out), seconds_between(shared_out, ordered),
              1e6 * seconds_between(begin, ordered) / static_cast<double>(mesh.nodes.size()),
              static_cast<double>(usage.ru_maxrss) / 1e6);
}

}  // namespace

/// Usage: mesh_benchmark [largest refinement]; 4 means 936 000 nodes.
int main(int argc, char** argv) {
  const int largest = argc > 1 ? std::atoi(argv[1]) : 4;
  std::printf("    nodes  elements  mesh s  8 parts s order s us a node peak GB\n");
  std::fflush(stdout);
  for (int refine = 0; refine <= largest; ++refine) {
    const pid_t child = fork();
    if (child == 0) {
      measure(refine);
      std::fflush(stdout);
      _exit(0);
    }
    int status = 0;
    waitpid(child, &status, 0);
    if (status != 0) return 1;
  }
  return 0;
}
