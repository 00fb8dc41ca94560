// SPDX-License-Identifier: GPL-3.0-or-later
// Estimated over true error of frequencies. README.md says what is compared.
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>

#include "fe_modal/algebra/petsc_session.h"
#include "fe_modal/analysis/modal_analysis.h"
#include "mesher/gmsh/mesh_import.h"
#include "mesher/mesh/refinement.h"
#include "tests/support/block_mesh.h"
#include "tests/support/element_meshes.h"
#include "tests/support/neck_mesh.h"

namespace {

using namespace flexneck;
using namespace flexneck::fe_modal;
using mesher::ElementKind;

ModalOptions options_of(const std::string& fixed, int count) {
  ModalOptions options;
  options.fixed_set = fixed;
  options.mode_count = count;
  return options;
}

/// A steel plate on a rubber ring, bonded to it and to the ground.
mesher::Mesh bonded_ring(int refinement, double poissons_ratio) {
  testing::BlockMesh ring =
      testing::tube({2 * refinement, 8 * refinement, 1}, 0.01, 0.04, 0.03, {});
  ring.slices = {{"pad", 2 * refinement, {"rubber", 8.3e6, poissons_ratio, 950}},
                 {"plate", refinement, {"steel", 2.1e11, 0.3, 7850}}};
  return ring.make();
}

mesher::Mesh tube(const mesher::Material& material) {
  return testing::tube({1, 8, 3}, 0.04, 0.06, 0.3, material).make();
}

mesher::Mesh neck(const std::string& set, int layers) {
  geometry::NeckDivisions divisions;
  if (layers < 3) {
    divisions.inner_ring = 2;
    divisions.rubber_layers = layers;
  }
  return testing::neck_mesh(set, divisions);
}

/// A clamped bar of tetrahedra, as a user brings it.
mesher::Mesh imported_bar() {
  mesher::ImportOptions options;
  options.file = FLEXNECK_SOURCE_DIR "/geometry/examples/cantilever.msh";
  options.length_unit_m = 1e-3;
  options.materials = {{"aluminium", 70e9, 0.33, 2700}};
  options.material_of_part["bar"] = "aluminium";
  return mesher::import_mesh(options, {});
}

/// Frequencies with every element cut in eight so many times.
Eigen::VectorXd reference_Hz(const mesher::Mesh& mesh, const ModalOptions& options, int cuts) {
  mesher::Mesh finest = mesh;
  for (int k = 0; k < cuts; ++k) finest = mesher::refine(finest).mesh;
  return analyse_modes(finest, options, {}).frequencies_Hz;
}

void print_problem(const char* title, const mesher::Mesh& mesh, ModalOptions options,
                   const Eigen::VectorXd& reference) {
  options.check = true;
  const auto start = std::chrono::steady_clock::now();
  const ModalBody body = analyse_modes(mesh, options, {});
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
  std::printf("%s: %zu nodes, %.1f s\n", title, mesh.nodes.size(), spent.count());
  std::printf("  %12s %12s %12s %10s %10s %8s %8s\n", "Hz", "refined", "reference", "true %",
              "estimate %", "ratio", "MAC");
  for (Eigen::Index k = 0; k < reference.size(); ++k) {
    const MeshError& error = *body.modes[static_cast<std::size_t>(k)].mesh_error;
    const double truth = body.frequencies_Hz[k] / reference[k] - 1;
    std::printf("  %12.5f %12.5f %12.5f %10.5f %10.5f %8.2f %8.5f\n", body.frequencies_Hz[k],
                error.refined_Hz, reference[k], 100 * truth, 100 * error.error,
                error.error / std::abs(truth), error.mac);
  }
  std::fflush(stdout);
}

/// Runs what the command line asks for.
struct Benchmark {
  int effort = 1;
  std::string wanted;  ///< part of the title; empty: all

  bool wants(const std::string& title) const { return title.find(wanted) != std::string::npos; }

  void rings() const {
    const ModalOptions bottom = options_of("bottom", 6);
    const mesher::Mesh ring = bonded_ring(1, 0.49);
    if (wants("bonded rubber ring"))
      print_problem("bonded rubber ring", ring, bottom,
                    reference_Hz(ring, bottom, effort > 0 ? 3 : 1));
    // At 0.495, above which they are refused.
    for (const double poissons_ratio : {0.49, 0.495})
      for (const ElementKind kind :
           {ElementKind::tet10, ElementKind::hex20, ElementKind::hex8, ElementKind::prism15,
            ElementKind::prism18, ElementKind::prism6})
        print_ring_of(kind, poissons_ratio, Formulation::mixed_pressure);
    print_ring_of(ElementKind::hex20, 0.49, Formulation::reduced);
    print_ring_of(ElementKind::hex20, 0.495, Formulation::reduced);
  }

  void print_ring_of(ElementKind kind, double poissons_ratio, Formulation formulation) const {
    std::array<char, 48> title{};
    std::snprintf(title.data(), title.size(), "%s%s, nu %g", mesher::name_of(kind).data(),
                  formulation == Formulation::reduced ? ", reduced" : "", poissons_ratio);
    if (!wants(title.data())) return;
    ModalOptions bottom = options_of("bottom", 6);
    const mesher::Mesh ring = bonded_ring(1, poissons_ratio);
    const Eigen::VectorXd reference = reference_Hz(ring, bottom, effort > 0 ? 2 : 1);
    bottom.formulation.of_others = formulation;
    print_problem(title.data(), testing::with_kind(ring, kind), bottom, reference);
  }

  void bars() const {
    const ModalOptions bottom = options_of("bottom", 6);
    const mesher::Mesh steel = tube({"steel", 2.1e11, 0.3, 7850});
    if (wants("steel tube"))
      print_problem("steel tube", steel, bottom, reference_Hz(steel, bottom, effort > 0 ? 2 : 1));
    ModalOptions clamp = options_of("clamp", 6);
    for (const Formulation formulation : {Formulation::displacement, Formulation::mixed_pressure}) {
      clamp.formulation.of_others = formulation;
      const std::string title = "imported tetrahedra, " + std::string(name_of(formulation));
      if (!wants(title)) continue;
      const mesher::Mesh bar = imported_bar();
      print_problem(title.c_str(), bar, clamp, reference_Hz(bar, clamp, effort > 0 ? 2 : 1));
    }
  }

  void necks() const {
    const ModalOptions bolts = options_of("bolts", 10);
    for (const std::string set : {"A", "C"}) {
      if (!wants("neck " + set)) continue;
      const mesher::Mesh usual = neck(set, 3);
      const Eigen::VectorXd reference = reference_Hz(usual, bolts, 1);
      print_problem(("neck " + set + ", coarse").c_str(), neck(set, 2), bolts, reference);
      print_problem(("neck " + set + ", default").c_str(), usual, bolts, reference);
    }
  }
};

}  // namespace

int main(int argc, char** argv) {
  Benchmark benchmark;
  if (argc > 1) benchmark.effort = std::atoi(argv[1]);
  if (argc > 2) benchmark.wanted = argv[2];
  try {
    const PetscSession session;
    benchmark.rings();
    benchmark.bars();
    if (benchmark.effort > 0) benchmark.necks();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
