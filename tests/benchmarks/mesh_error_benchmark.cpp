// SPDX-License-Identifier: GPL-3.0-or-later
// Ratio of estimated to true error of frequencies: manual/theory/mesh_error.md describes it.
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <functional>
#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "fe_modal/algebra/petsc_session.h"
#include "fe_modal/analysis/modal_analysis.h"
#include "mesher/gmsh/mesh_import.h"
#include "mesher/mesh/refinement.h"
#include "tests/support/block_mesh.h"
#include "tests/support/element_choices.h"
#include "tests/support/element_meshes.h"
#include "tests/support/neck_mesh.h"

namespace {

using namespace flexneck;
using namespace flexneck::fe_modal;
using mesher::ElementKind;
using testing::BlockMesh;

constexpr double kLeastRatio = 0.7;
constexpr double kLargestRatio = 5;

/// Mesh generator of a body, with n x n x n hexahedra of 27 nodes in place of each of its own.
using Generator = std::function<mesher::Mesh(int n)>;

/// Reference solution for frequencies.
struct Truth {
  Eigen::VectorXd frequencies_Hz;
  std::vector<Eigen::Matrix3Xd> shapes;
  std::map<std::array<long, 3>, Eigen::Index> nodes;  ///< indices of the nodes by position
  Eigen::VectorXd uncertainty;                        ///< relative uncertainty of the frequencies
};

/// A row of the table.
struct Body {
  std::string title;
  bool is_judged = false;  ///< true for a body that no constant was fitted to
  std::function<mesher::Mesh()> mesh;
  ModalOptions options;
  std::string truth;  ///< name of the reference; bodies with the same name share it
  std::function<Truth()> find_truth;
};

std::vector<std::array<long, 3>> places_of(const mesher::Mesh& mesh) {
  constexpr double kUnit_m = 1e-7;
  std::vector<std::array<long, 3>> places;
  for (const auto& [x, y, z] : mesh.nodes)
    places.push_back(
        {std::lround(x / kUnit_m), std::lround(y / kUnit_m), std::lround(z / kUnit_m)});
  return places;
}

void set_nodes(Truth& truth, const mesher::Mesh& mesh) {
  const auto places = places_of(mesh);
  truth.nodes.clear();
  for (std::size_t k = 0; k < places.size(); ++k)
    truth.nodes[places[k]] = static_cast<Eigen::Index>(k);
}

Truth truth_of(const mesher::Mesh& mesh, ModalOptions options) {
  // Number of modes beyond the requested ones, as coarse meshes have another order.
  constexpr int kMore = 30;
  options.mode_count += kMore;
  options.formulation = {};
  ModalBody body = analyse_modes(mesh, options, {});
  Truth truth{body.frequencies_Hz,
              std::move(body.shapes),
              {},
              Eigen::VectorXd::Zero(body.frequencies_Hz.size())};
  set_nodes(truth, mesh);
  return truth;
}

struct TrueFrequency {
  double Hz = 0;
  double uncertainty = 0;
};

/// True frequency of a shape: that of the most similar mode, or group of modes within 1 %; zero if
/// none is similar.
TrueFrequency find_true(const Truth& truth, const std::vector<std::array<long, 3>>& places,
                        const Eigen::Matrix3Xd& shape) {
  constexpr double kOneShape = 1e-2;
  constexpr double kSame = 0.8;
  const Eigen::Index count = truth.frequencies_Hz.size();
  Eigen::ArrayXd similarity(count);
  for (Eigen::Index j = 0; j < count; ++j) {
    const Eigen::Matrix3Xd& other = truth.shapes[static_cast<std::size_t>(j)];
    double product = 0;
    double norm = 0;
    double own = 0;
    for (std::size_t k = 0; k < places.size(); ++k) {
      const auto found = truth.nodes.find(places[k]);
      if (found == truth.nodes.end()) continue;
      const auto mine = shape.col(static_cast<Eigen::Index>(k));
      product += mine.dot(other.col(found->second));
      norm += other.col(found->second).squaredNorm();
      own += mine.squaredNorm();
    }
    similarity[j] = product * product / (norm * own);
  }
  Eigen::Index best = 0;
  similarity.maxCoeff(&best);
  double all = 0;
  double weighted = 0;
  for (Eigen::Index j = 0; j < count; ++j) {
    const double distance = truth.frequencies_Hz[j] / truth.frequencies_Hz[best] - 1;
    if (std::abs(distance) > kOneShape) continue;
    all += similarity[j];
    weighted += similarity[j] * truth.frequencies_Hz[j];
  }
  if (all < kSame) return {};
  return {weighted / all, truth.uncertainty[best]};
}

ModalOptions options_of(const std::string& fixed, int count,
                        Formulation formulation = Formulation::mixed_pressure) {
  ModalOptions options;
  options.fixed_set = fixed;
  options.mode_count = count;
  options.formulation.of_others = formulation;
  return options;
}

/// Reference with n x n x n elements in place of one; the change from half as many shows its
/// uncertainty.
Truth finer_truth(const Generator& body, int n, const ModalOptions& options) {
  Truth truth = truth_of(body(n), options);
  ModalOptions plain = options;
  plain.formulation = {};
  const mesher::Mesh half = body(n / 2);
  const ModalBody coarser = analyse_modes(half, plain, {});
  const auto places = places_of(half);
  for (Eigen::Index k = 0; k < options.mode_count; ++k) {
    if (coarser.frequencies_Hz[k] == 0) continue;
    const double found = find_true(truth, places, coarser.shapes[static_cast<std::size_t>(k)]).Hz;
    // The remaining error is as large as the change at order one, and a third of it at order two,
    // the most common one.
    truth.uncertainty[k] = std::abs(coarser.frequencies_Hz[k] / found - 1) / 2;
  }
  return truth;
}

/// Reference for a slender beam of square section, fixed at z = 0, by Euler and Bernoulli, with its
/// longitudinal and torsional modes.
Truth slender_truth(const mesher::Mesh& mesh, double side_m, double length_m,
                    const mesher::Material& material) {
  constexpr double kTwist = 0.1406;  // torsion constant of a square over its side to the fourth
  const double wave_m_s = std::sqrt(material.youngs_modulus_Pa / material.density_kg_m3);
  const double shear_m_s = wave_m_s / std::sqrt(2 * (1 + material.poissons_ratio));
  const double pi = std::numbers::pi;
  Truth truth;
  std::vector<double> found;
  const auto add = [&](double frequency_Hz, const auto& displacement) {
    found.push_back(frequency_Hz);
    Eigen::Matrix3Xd& shape =
        truth.shapes.emplace_back(3, static_cast<Eigen::Index>(mesh.nodes.size()));
    for (std::size_t k = 0; k < mesh.nodes.size(); ++k)
      shape.col(static_cast<Eigen::Index>(k)) =
          displacement(Eigen::Vector3d(mesh.nodes[k].data()), mesh.nodes[k][2] / length_m);
  };
  for (int n = 1; n <= 10; ++n) {
    double root = (n - 0.5) * pi;  // root of cos r cosh r = -1
    for (int step = 0; step < 20; ++step)
      root -= (std::cos(root) + 1 / std::cosh(root)) /
              (-std::sin(root) - std::tanh(root) / std::cosh(root));
    const double ratio = (std::cos(root) + std::cosh(root)) / (std::sin(root) + std::sinh(root));
    const double bending_Hz =
        root * root * wave_m_s * side_m / std::sqrt(12.0) / (length_m * length_m) / (2 * pi);
    for (int axis = 0; axis < 2; ++axis)
      add(bending_Hz, [&](const Eigen::Vector3d&, double s) -> Eigen::Vector3d {
        return Eigen::Vector3d::Unit(axis) * (std::cosh(root * s) - std::cos(root * s) -
                                              ratio * (std::sinh(root * s) - std::sin(root * s)));
      });
    const double wave_number = (n - 0.5) * pi;
    add(wave_number * wave_m_s / length_m / (2 * pi), [&](const Eigen::Vector3d&, double s) {
      return Eigen::Vector3d(0, 0, std::sin(wave_number * s));
    });
    add(wave_number * shear_m_s * std::sqrt(6 * kTwist) / length_m / (2 * pi),
        [&](const Eigen::Vector3d& x, double s) {
          return Eigen::Vector3d(Eigen::Vector3d(-x[1], x[0], 0) * std::sin(wave_number * s));
        });
  }
  truth.frequencies_Hz = Eigen::Map<Eigen::VectorXd>(found.data(), std::ssize(found));
  set_nodes(truth, mesh);
  truth.uncertainty.setConstant(truth.frequencies_Hz.size(),
                                side_m / length_m / 4);  // the clamped end is fixed sideways, too
  return truth;
}

Generator beam(double aspect) {
  return [=](int n) {
    return testing::box({n, n, 8 * n}, {0.01, 0.01, 0.08 * aspect}, kSteel).make();
  };
}

/// A plate fixed along one side.
Generator plate(double aspect) {
  return [=](int n) {
    return testing::box({n, 4 * n, 4 * n}, {0.01, 0.04 * aspect, 0.04 * aspect}, kSteel).make();
  };
}

Truth plate_truth(double aspect) {
  // Thicker plates bend in the same way, and are less affected by rounding.
  const double solved = std::min(aspect, 100.0);
  Truth truth = finer_truth(plate(solved), 4, options_of("bottom", 6));
  truth.frequencies_Hz *= (solved / aspect) * (solved / aspect);
  set_nodes(truth, plate(aspect)(4));
  return truth;
}

/// A steel plate on a rubber ring, bonded to it and to the ground.
Generator bonded_ring(double poissons_ratio) {
  return [=](int n) {
    BlockMesh ring = testing::tube({2 * n, 8 * n, 1}, 0.01, 0.04, 0.03, {});
    ring.slices = {{"pad", 2 * n, {"rubber", 8.3e6, poissons_ratio, 950}},
                   {"plate", n, {"steel", 2.1e11, 0.3, 7850}}};
    return ring.make();
  };
}

mesher::Mesh tube(int n) {
  return testing::tube({n, 8 * n, 3 * n}, 0.04, 0.06, 0.3, kSteel).make();
}

/// Layers of steel, rubber and steel, all three fixed at one end.
mesher::Mesh sandwich(int n) {
  BlockMesh block = testing::box({6 * n, 2 * n, 1}, {1, 1, 1}, kSteel);
  mesher::Material upper = kSteel;
  upper.name = "steel above";
  block.slices = {{"lower", n, kSteel}, {"core", n, kRubber}, {"upper", n, upper}};
  block.position = [](const Eigen::Vector3d& p) -> Eigen::Vector3d {
    return {0.24 * p[0], 0.04 * p[1], 0.012 * p[2]};
  };
  mesher::Mesh mesh = block.make();
  mesher::NodeSet held{"held", {}};
  for (std::size_t k = 0; k < mesh.nodes.size(); ++k)
    if (mesh.nodes[k][0] == 0) held.nodes.push_back(static_cast<std::int32_t>(k));
  mesh.node_sets.push_back(held);
  return mesh;
}

/// A quarter of a thin-walled cylinder, fixed along its lower rim.
mesher::Mesh shell(int n) {
  BlockMesh block = testing::box({n, 6 * n, 4 * n}, {1, 1, 1}, kSteel);
  block.position = [](const Eigen::Vector3d& p) -> Eigen::Vector3d {
    const double angle = std::numbers::pi / 2 * p[1];
    const double radius = 0.1 + 0.002 * p[0];
    return {radius * std::cos(angle), radius * std::sin(angle), 0.12 * p[2]};
  };
  return block.make();
}

/// A lump of rubber with no straight edge, bonded at its bottom; its elements have the same
/// curvature.
mesher::Mesh lump(int n) {
  BlockMesh block = testing::box({2 * n, 2 * n, 2 * n}, {1, 1, 1}, kRubber);
  block.position = [](const Eigen::Vector3d& p) -> Eigen::Vector3d {
    return 0.05 * testing::distorted(p);
  };
  return block.make();
}

/// An angle of steel: its inner edge is re-entrant.
mesher::Mesh angle(int n) {
  const mesher::Mesh full = testing::box({4 * n, 2 * n, 4 * n}, {0.08, 0.04, 0.08}, kSteel).make();
  return testing::with_kinds(full, [](const Eigen::Vector3d& x) -> std::optional<ElementKind> {
    if (x[0] > -0.02 && x[2] > 0.02) return std::nullopt;
    return ElementKind::hex27;
  });
}

/// A bar of steel with a crack through half of its section.
mesher::Mesh cracked(int n) {
  const mesher::Mesh whole = testing::box({2 * n, 2 * n, 6 * n}, {0.04, 0.04, 0.12}, kSteel).make();
  mesher::Mesh cut = testing::with_slit(whole, 0.04, false, [](const Eigen::Vector3d& x) {
    return std::abs(x[2] - 0.04) < 1e-9 && x[0] > 1e-9;
  });
  cut.slits.clear();  // double nodes alone make the crack
  return cut;
}

mesher::Mesh neck(const std::string& set, int layers) {
  geometry::NeckDivisions divisions;
  if (layers < 3) {
    divisions.inner_ring = 2;
    divisions.rubber_layers = layers;
  }
  return testing::neck_mesh(set, divisions);
}

/// A clamped bar of tetrahedra, as imported from a user's file.
mesher::Mesh imported_bar() {
  mesher::ImportOptions options;
  options.file = FLEXNECK_SOURCE_DIR "/geometry/examples/cantilever.msh";
  options.length_unit_m = 1e-3;
  options.materials = {{"aluminium", 70e9, 0.33, 2700}};
  options.material_of_part["bar"] = "aluminium";
  return mesher::import_mesh(options, {});
}

/// Reference from a mesh whose elements were cut in eight `cuts` times.
Truth refined_truth(mesher::Mesh mesh, int cuts, const ModalOptions& options) {
  for (int k = 0; k < cuts; ++k) mesh = mesher::refine(mesh).mesh;
  return truth_of(mesh, options);
}

/// All rows of the table.
class Bodies {
 public:
  void add(const std::string& title, bool is_judged, const Generator& body, ElementKind kind,
           const ModalOptions& options, const std::string& truth,
           const std::function<Truth()>& find_truth) {
    all_.push_back({title, is_judged, [=] { return testing::with_kind(body(1), kind); }, options,
                    truth, find_truth});
  }

  /// Adds a slender body of each kind and aspect ratio: the aspect ratios 10 and 200 are held out.
  void add_slender() {
    for (const double aspect : {1.0, 10.0, 50.0, 200.0}) {
      const std::string ratio = std::to_string(static_cast<int>(aspect));
      const bool is_judged = aspect == 10 || aspect == 200;
      for (const ElementKind kind : kVolumes)
        for (const Formulation formulation : kFormulations) {
          if (!offered(kind, formulation)) continue;
          const std::string name = std::string(mesher::name_of(kind)) + " " +
                                   std::string(name_of(formulation)) + " " + ratio;
          const ModalOptions options = options_of("bottom", 6, formulation);
          add("beam " + name, is_judged, beam(aspect), kind, options, "beam " + ratio, [=] {
            return aspect > 10 ? slender_truth(beam(aspect)(1), 0.01, 0.08 * aspect, kSteel)
                               : finer_truth(beam(aspect), 4, options_of("bottom", 6));
          });
          add("plate " + name, is_judged, plate(aspect), kind, options, "plate " + ratio,
              [=] { return plate_truth(aspect); });
        }
    }
  }

  void add_rings() {
    for (const double ratio : {0.49, 0.495})
      for (const ElementKind kind : kVolumes)
        for (const Formulation formulation : {Formulation::mixed_pressure, Formulation::reduced}) {
          if (!offered(kind, formulation)) continue;
          const std::string title = "ring " + std::string(mesher::name_of(kind)) + " " +
                                    std::string(name_of(formulation));
          const std::string nu = " nu " + std::to_string(ratio).substr(0, 5);
          add(title + nu, ratio > 0.49, bonded_ring(ratio), kind,
              options_of("bottom", 6, formulation), "ring" + nu,
              [=] { return finer_truth(bonded_ring(ratio), 4, options_of("bottom", 6)); });
        }
  }

  /// Adds other bodies in the most common kinds of elements.
  void add_others() {
    struct Other {
      std::string name;
      bool is_judged;
      Generator body;
      std::string held;
    };
    const std::vector<Other> others = {
        {"tube", false, tube, "bottom"},      {"sandwich", true, sandwich, "held"},
        {"shell", true, shell, "bottom"},     {"lump", true, lump, "bottom"},
        {"free lump", true, lump, ""},        {"angle", true, angle, "bottom"},
        {"cracked", false, cracked, "bottom"}};
    for (const Other& other : others)
      for (const ElementKind kind :
           {ElementKind::hex27, ElementKind::hex20, ElementKind::tet10, ElementKind::hex8}) {
        const ModalOptions options = options_of(other.held, other.held.empty() ? 12 : 6);
        add(other.name + " " + std::string(mesher::name_of(kind)), other.is_judged, other.body,
            kind, options, other.name, [=] { return finer_truth(other.body, 4, options); });
      }
  }

  void add_files() {
    for (const Formulation formulation : {Formulation::displacement, Formulation::mixed_pressure}) {
      const ModalOptions clamp = options_of("clamp", 6, formulation);
      all_.push_back({"imported tetrahedra " + std::string(name_of(formulation)), false,
                      imported_bar, clamp, "imported",
                      [=] { return refined_truth(imported_bar(), 2, clamp); }});
    }
    const ModalOptions bolts = options_of("bolts", 10);
    for (const std::string set : {"A", "C"}) {
      // Cut in eight the default neck has 191 000 degrees of freedom, cut again it exceeds any
      // memory: the mesh compared with the reference is therefore coarser.
      const auto truth = [=] { return refined_truth(neck(set, 3), 1, bolts); };
      const bool is_judged = set == "C";
      all_.push_back({"neck " + set + " coarse hex27", is_judged, [=] { return neck(set, 2); },
                      bolts, "neck " + set, truth});
      all_.push_back({"neck " + set + " default hex20", is_judged,
                      [=] { return testing::with_kind(neck(set, 3), ElementKind::hex20); }, bolts,
                      "neck " + set, truth});
    }
  }

  const std::vector<Body>& all() const { return all_; }

 private:
  std::vector<Body> all_;
};

struct Tally {
  int compared = 0;
  int inside = 0;
  double least = HUGE_VAL;
  double largest = 0;
};

/// Prints a row, and with `detailed` a line for each mode.
void print_body(const Body& body, const Truth& truth, bool detailed, Tally& tally) {
  ModalOptions options = body.options;
  options.check = true;
  const mesher::Mesh mesh = body.mesh();
  const auto places = places_of(mesh);
  const auto start = std::chrono::steady_clock::now();
  const ModalBody found = analyse_modes(mesh, options, {});
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
  std::string ratios;
  std::string lines;
  double largest_error = 0;
  for (Eigen::Index k = 0; k < found.mode_count(); ++k) {
    const MeshError& estimate = *found.modes[static_cast<std::size_t>(k)].mesh_error;
    if (found.frequencies_Hz[k] == 0) continue;
    const auto [true_Hz, uncertainty] =
        find_true(truth, places, found.shapes[static_cast<std::size_t>(k)]);
    const double error = std::abs(found.frequencies_Hz[k] / true_Hz - 1);
    const double ratio = estimate.error / error;
    std::array<char, 160> line{};
    std::snprintf(line.data(), line.size(), "    %11.4f %11.4f %11.4f %9.4f %9.4f %7.2f %7.4f\n",
                  found.frequencies_Hz[k], estimate.refined_Hz, true_Hz, 100 * error,
                  100 * estimate.error, ratio, estimate.mac);
    lines += line.data();
    // Smaller errors cannot be distinguished from those of the reference.
    const bool is_known = true_Hz > 0 && error > 3 * uncertainty;
    std::snprintf(line.data(), line.size(),
                  true_Hz == 0 ? " -"
                  : is_known   ? " %.2f"
                               : " (%.2f)",
                  ratio);
    ratios += line.data();
    if (!is_known) continue;
    largest_error = std::max(largest_error, error);
    ++tally.compared;
    if (ratio >= kLeastRatio && ratio <= kLargestRatio) ++tally.inside;
    tally.least = std::min(tally.least, ratio);
    tally.largest = std::max(tally.largest, ratio);
  }
  std::printf("%-36s %c %7.3f %5.1f %s %s\n", body.title.c_str(), body.is_judged ? 'j' : 'f',
              100 * largest_error, spent.count(), ratios.c_str(),
              found.mesh_error_limits.empty() ? "" : "indication");
  if (detailed) std::printf("%s", lines.c_str());
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  const int effort = argc > 1 ? std::atoi(argv[1]) : 1;
  const std::string wanted = argc > 2 ? argv[2] : effort == 0 ? "lump hex" : "";
  try {
    const PetscSession session;
    Bodies bodies;
    bodies.add_rings();
    bodies.add_others();
    bodies.add_slender();
    bodies.add_files();
    std::map<std::string, Truth> truths;
    std::array<Tally, 2> tallies;
    std::printf("body, fitted or judged, largest error %%, s, estimate over error of each mode\n");
    for (const Body& body : bodies.all()) {
      if (body.title.find(wanted) == std::string::npos) continue;
      if (!truths.contains(body.truth)) truths[body.truth] = body.find_truth();
      try {
        print_body(body, truths.at(body.truth), effort > 1, tallies[body.is_judged ? 1 : 0]);
      } catch (const std::exception& error) {  // e.g. elements with too few points
        std::printf("%s: %s\n", body.title.c_str(), error.what());
      }
    }
    for (const std::size_t k : {0U, 1U})
      std::printf("%s: %d of %d modes inside %g to %g, from %.2f to %.2f\n",
                  k == 0 ? "fitted" : "judged", tallies[k].inside, tallies[k].compared, kLeastRatio,
                  kLargestRatio, tallies[k].least, tallies[k].largest);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
