// SPDX-License-Identifier: GPL-3.0-or-later
// Time and arithmetic of the element matrices. README.md describes the comparison.
#include <array>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "fe_modal/algebra/matrix_product.h"
#include "fe_modal/element/element_kernel.h"
#include "mesher/mesh/mesh_measures.h"
#include "mesher/mesh/positions.h"
#include "mesher/mesh/shape_functions.h"
#include "tests/benchmarks/timing.h"
#include "tests/support/block_mesh.h"
#include "tests/support/element_choices.h"
#include "tests/support/element_meshes.h"

namespace {

using namespace flexneck;
using namespace flexneck::fe_modal;
using mesher::ElementKind;

/// Speed of a b^T with a and b (rows, depth), GFLOP/s.
double product_speed(Eigen::Index rows, Eigen::Index depth, int runs) {
  const Eigen::MatrixXd a = Eigen::MatrixXd::Random(rows, depth);
  Eigen::MatrixXd result(rows, rows);
  constexpr int kRepeats = 2;  // short, so that some run is not interrupted
  const auto timing = benchmarks::measure(runs, [&] {
    for (int k = 0; k < kRepeats; ++k) multiply_by_transpose(1, a, a, 0, result);
  });
  const auto n = static_cast<double>(rows);
  return kRepeats * 2 * n * n * static_cast<double>(depth) / timing.fastest_ms / 1e6;
}

/// Number of operations of the matrix products alone: int N_i,a N_j,b, the mass and the pressures.
double product_operations(const ElementScheme& scheme) {
  const auto n = static_cast<double>(mesher::nodes_per_element(scheme.kind));
  const auto points = [&](int strength) {
    return static_cast<double>(mesher::gauss_rule(scheme.kind, strength).weights.size());
  };
  const double q = points(scheme.strength);
  constexpr std::array kPressures = {0.0, 1.0, 2.0, 4.0};
  const double p = kPressures.at(static_cast<std::size_t>(scheme.pressures));
  return 2 * (9 * n * n * q + n * n * points(3) + 3 * n * q * p + 9 * n * n * p);
}

void print_row(ElementKind kind, Formulation formulation, double peak, int runs) {
  const ElementScheme& scheme = element_scheme(kind, formulation);
  testing::BlockMesh block = testing::box({1, 1, 1}, {1, 1, 1}, {"rubber", 8.3e6, 0.49, 950});
  block.position = testing::distorted;
  const mesher::Mesh mesh = testing::with_kind(block.make(), kind);
  const Eigen::Matrix3Xd nodes = mesher::positions_of(
      mesh, std::span(mesh.blocks[0].nodes).first(mesher::nodes_per_element(kind)));
  ElementKernel kernel(scheme);
  ElementMatrices matrices;
  constexpr int kRepeats = 20;
  const auto timing = benchmarks::measure(runs, [&] {
    for (int k = 0; k < kRepeats; ++k) kernel.compute(nodes, mesh.materials[0], matrices);
  });
  const double seconds = timing.fastest_ms / 1e3 / kRepeats;
  const double speed = product_operations(scheme) / seconds / 1e9;
  const auto n = static_cast<Eigen::Index>(mesher::nodes_per_element(kind));
  const Eigen::Index q = mesher::gauss_rule(kind, scheme.strength).weights.size();
  std::printf("%-8s %-15s %9.2f %10.2f %7.0f %% %18.1f\n",
              std::string(mesher::name_of(kind)).c_str(), std::string(name_of(formulation)).c_str(),
              1e6 * seconds, speed, 100 * speed / peak, product_speed(3 * n, q, runs));
}

}  // namespace

int main(int argc, char** argv) {
  const int runs = argc > 1 ? std::atoi(argv[1]) : 21;
  if (runs < 1) {
    std::fprintf(stderr, "usage: %s [RUNS]\n", argv[0]);
    return 2;
  }
  try {
    setenv("OPENBLAS_NUM_THREADS", "1", 1);
    const double peak = product_speed(256, 256, 5 * runs);
    std::printf("peak, 256 x 256 x 256: %.1f GFLOP/s\n", peak);
    std::printf("%-8s %-15s %9s %10s %9s %18s\n", "kind", "formulation", "us each", "GFLOP/s",
                "of peak", "its product alone");
    for (const ElementKind kind : kVolumes) {
      for (const Formulation formulation : kFormulations) {
        if (offered(kind, formulation)) print_row(kind, formulation, peak, runs);
      }
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
