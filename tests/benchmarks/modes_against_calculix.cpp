// SPDX-License-Identifier: GPL-3.0-or-later
// Times the neck's ten modes by `flexneck modes` and by CalculiX on the same meshes. README.md
// describes the comparison.
#include <array>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <optional>
#include <stdexcept>
#include <string>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

#include <Eigen/Core>

#include "fe_modal/body/modal_body_file.h"
#include "geometry/foundation/temporary_folder.h"
#include "tests/support/calculix.h"

namespace {

using namespace flexneck;

struct Cost {
  double cpu_s = 0;
  double memory_GB = 0;  ///< peak
};

/// Runs a command without its output, on one thread.
Cost cost_of(const std::string& command) {
  const pid_t child = fork();
  if (child == 0) {
    setenv("OMP_NUM_THREADS", "1", 1);
    setenv("OPENBLAS_NUM_THREADS", "1", 1);
    const std::string silent = "exec " + command + " > /dev/null 2>&1";
    execl("/bin/sh", "sh", "-c", silent.c_str(), static_cast<char*>(nullptr));
    _exit(127);
  }
  int status = 0;
  rusage usage{};
  if (child < 0 || wait4(child, &status, 0, &usage) != child || status != 0) {
    throw std::runtime_error("failed: " + command);
  }
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return {seconds(usage.ru_utime) + seconds(usage.ru_stime),
          static_cast<double>(usage.ru_maxrss) / 1048576};
}

struct Solution {
  Cost cost;
  Eigen::VectorXd hertz;
};

/// A mesh of the neck in a folder of its own.
class Neck {
 public:
  Neck(const std::filesystem::path& folder, const std::string& settings)
      : folder_(folder), settings_(" -o " + folder.string() + " " + settings) {
    cost_of(flexneck("mesh"));
  }

  Solution by_flexneck() const {
    const Cost cost = cost_of(flexneck("modes --set modes.attached_body=''"));
    return {cost, fe_modal::read_modal_body(folder_ / "modes.h5").body.frequencies_Hz};
  }

  Solution by_calculix() const {
    const std::filesystem::path deck = folder_ / "deck.inp";
    cost_of(flexneck("export --to " + deck.string()));
    const Cost cost = cost_of("sh -c \"cd '" + folder_.string() + "' && exec ccx -i deck\"");
    const std::vector<double> hertz = testing::read_calculix_frequencies(folder_ / "deck.dat");
    return {cost, Eigen::Map<const Eigen::VectorXd>(hertz.data(),
                                                    static_cast<Eigen::Index>(hertz.size()))};
  }

  Eigen::Index dofs() const {
    return 3 * fe_modal::read_modal_body(folder_ / "modes.h5").body.nodes_m.cols();
  }

 private:
  std::string flexneck(const std::string& command) const {
    return std::string(FLEXNECK_BINARY_DIR) + "/flexneck " + command + settings_;
  }

  std::filesystem::path folder_;
  std::string settings_;
};

double largest_difference(const Eigen::VectorXd& one, const Eigen::VectorXd& other) {
  const Eigen::Index count = std::min(one.size(), other.size());
  return (one.head(count).array() / other.head(count).array() - 1).abs().maxCoeff();
}

constexpr std::array kSizes = {
    "--set mesh.quadrant=3 --set mesh.inner_ring=2 --set mesh.rubber_layers=2",
    "--set mesh.quadrant=7 --set mesh.inner_ring=5 --set mesh.outer_ring=2"
    " --set mesh.rubber_layers=5",
    "--set mesh.quadrant=10 --set mesh.inner_ring=9 --set mesh.outer_ring=4"
    " --set mesh.rubber_layers=7"};

void compare(std::size_t sizes, bool has_peer) {
  const TemporaryFolder folder;
  const Neck usual(folder / "usual", "");
  const Neck coarse(folder / "coarse", kSizes[0]);
  const Eigen::VectorXd converged = usual.by_flexneck().hertz;
  const Solution mixed = coarse.by_flexneck();
  std::printf(
      "20-node hexahedra, reduced: CPU in s, peak memory in GB, error of the ten against\n"
      "flexneck on 27-node hexahedra, mixed, %ld DOF\n",
      static_cast<long>(usual.dofs()));
  std::printf("%8s | %8s %6s | %8s %6s | %8s %8s | %12s %8s\n", "DOF", "flexneck", "GB", "ccx",
              "GB", "CPU 1:", "memory", "difference", "error");
  std::optional<Solution> last;
  for (std::size_t k = 0; k < sizes; ++k) {
    const Neck neck(
        folder / std::to_string(k),
        std::string(kSizes[k]) + " --set mesh.element=hex20 --set modes.formulation=reduced");
    const Solution ours = neck.by_flexneck();
    std::printf("%8ld | %8.2f %6.2f |", static_cast<long>(neck.dofs()), ours.cost.cpu_s,
                ours.cost.memory_GB);
    if (has_peer) {
      last = neck.by_calculix();
      std::printf(" %8.2f %6.2f | %8.1f %8.2f | %12.1e %7.2f%%\n", last->cost.cpu_s,
                  last->cost.memory_GB, last->cost.cpu_s / ours.cost.cpu_s,
                  ours.cost.memory_GB / last->cost.memory_GB,
                  largest_difference(ours.hertz, last->hertz),
                  100 * largest_difference(last->hertz, converged));
    } else {
      std::printf(" ccx: not run\n");
    }
    std::fflush(stdout);
  }
  std::printf("27-node hexahedra, mixed, %ld DOF: %.2f s, error %.2f %%",
              static_cast<long>(coarse.dofs()), mixed.cost.cpu_s,
              100 * largest_difference(mixed.hertz, converged));
  if (last) std::printf("; 1 : %.0f of ccx's last", last->cost.cpu_s / mixed.cost.cpu_s);
  std::printf("\n");
}

}  // namespace

int main(int argc, char** argv) {
  const int sizes = argc > 1 ? std::atoi(argv[1]) : 3;
  if (sizes < 1 || sizes > static_cast<int>(kSizes.size())) {
    std::fprintf(stderr, "usage: %s [SIZES, 1 to 3]\n", argv[0]);
    return 2;
  }
  try {
    const bool has_peer = std::system("command -v ccx > /dev/null 2>&1") == 0;
    compare(static_cast<std::size_t>(sizes), has_peer);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
