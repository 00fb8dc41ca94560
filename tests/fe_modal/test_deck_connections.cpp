// SPDX-License-Identifier: GPL-3.0-or-later
// Supports, couplings, equations, masses and springs of decks: CalculiX finds the same frequencies
// with the same .inp, and an equivalent .bdf gives them again.
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "fe_modal/analysis/modal_analysis.h"
#include "geometry/foundation/temporary_folder.h"
#include "mesher/exchange/inp_writer.h"
#include "mesher/gmsh/mesh_import.h"
#include "mesher/mesh/mesh_file.h"
#include "tests/support/block_mesh.h"
#include "tests/support/calculix.h"
#include "tests/support/element_choices.h"
#include "tests/support/element_meshes.h"
#include "tests/support/files.h"

namespace flexneck::fe_modal {
namespace {

mesher::Mesh bar(mesher::ElementKind kind) {
  return testing::with_kind(testing::box({2, 2, 4}, {0.2, 0.3, 0.8}, kSteel).make(), kind);
}

/// Numbers of the nodes in a region, as in the deck, which counts from 1.
std::vector<std::size_t> numbers_at(const mesher::Mesh& mesh,
                                    const std::function<bool(double, double, double)>& is_in) {
  std::vector<std::size_t> numbers;
  for (std::size_t k = 0; k < mesh.nodes.size(); ++k) {
    const auto& [x, y, z] = mesh.nodes[k];
    if (is_in(x, y, z)) numbers.push_back(k + 1);
  }
  return numbers;
}

bool is(double one, double other) { return std::abs(one - other) < 1e-9; }

std::size_t at(const mesher::Mesh& mesh, double x, double y, double z) {
  return numbers_at(mesh,
                    [=](double u, double v, double w) { return is(u, x) && is(v, y) && is(w, z); })
      .front();
}

/// Content of both decks: two edges in axes of their own, a corner fixed in x, the upper end on a
/// rigid body with a mass, springs, and a constant distance.
struct Deck {
  explicit Deck(const mesher::Mesh& mesh)
      : radial(numbers_at(mesh, [](double x, double, double z) { return is(x, 0.1) && is(z, 0); })),
        oblique(
            numbers_at(mesh, [](double x, double, double z) { return is(x, -0.1) && is(z, 0); })),
        top(numbers_at(mesh, [](double, double, double z) { return is(z, 0.8); })),
        held(at(mesh, -0.1, 0.15, 0.4)),
        sprung(at(mesh, 0.1, -0.15, 0.4)),
        heavy(at(mesh, 0.1, 0.15, 0.6)),
        geared(at(mesh, -0.1, -0.15, 0.6)),
        above(at(mesh, 0.1, -0.15, 0.6)),
        below(at(mesh, -0.1, -0.15, 0.2)) {}

  std::vector<std::size_t> radial, oblique, top;
  std::size_t held, sprung, heavy, geared, above, below;
};

std::string listed(const std::vector<std::size_t>& numbers) {
  std::string text;
  for (const std::size_t number : numbers) text += std::to_string(number) + ",\n";
  return text;
}

/// Cards of the .inp: reference point 9001 at (0.03, 0, 0.9), its rotations at node 9002; 9003 is
/// held by two springs.
std::string inp_cards(const Deck& deck) {
  const auto n = [](std::size_t number) { return std::to_string(number); };
  return "*NODE\n9001,0.03,0.,0.9\n9002,0.03,0.,0.9\n9003,0.5,0.,0.5\n"
         "*NSET,NSET=radial\n" +
         listed(deck.radial) + "*NSET,NSET=oblique\n" + listed(deck.oblique) +
         "*NSET,NSET=upper\n" + listed(deck.top) +
         "*TRANSFORM,NSET=radial,TYPE=C\n0.5,0.2,0.,0.5,0.2,1.\n"
         "*TRANSFORM,NSET=oblique,TYPE=R\n0.6,0.8,0.,-0.8,0.6,0.\n"
         "*BOUNDARY\nradial,1\nradial,3\noblique,1\noblique,3\n" +
         n(deck.held) +
         ",2\n"
         "9003,1\n9003,2\n"
         "*RIGID BODY,NSET=upper,REF NODE=9001,ROT NODE=9002\n"
         "*EQUATION\n3\n" +
         n(deck.geared) +
         ",1,2.,9001,2,-1.,9002,3,0.3\n"
         "*ELEMENT,TYPE=MASS,ELSET=masses\n9001,9001\n9002," +
         n(deck.heavy) +
         "\n"
         "*MASS,ELSET=masses\n12.5\n"
         "*ELEMENT,TYPE=MASS,ELSET=hanging\n9003,9003\n*MASS,ELSET=hanging\n3.\n"
         "*ELEMENT,TYPE=SPRING1,ELSET=ground\n9011," +
         n(deck.sprung) +
         "\n"
         "*SPRING,ELSET=ground\n2\n4.e8\n"
         "*ELEMENT,TYPE=SPRING2,ELSET=between\n9012," +
         n(deck.sprung) + "," + n(deck.heavy) +
         "\n"
         "*SPRING,ELSET=between\n1,1\n2.e8\n"
         "*ELEMENT,TYPE=SPRING2,ELSET=soft\n9013,9003," +
         n(deck.heavy) +
         "\n"
         "*SPRING,ELSET=soft\n3,3\n3.e6\n"
         "*ELEMENT,TYPE=SPRINGA,ELSET=along\n9014," +
         n(deck.sprung) + "," + n(deck.above) + "\n*SPRING,ELSET=along\n\n5.e8\n";
}

/// Cards of the .bdf. SPC1, MPC and CORD are selected without a case control: there is one set of
/// each.
std::string bdf_cards(const Deck& deck) {
  const auto n = [](std::size_t number) { return std::to_string(number); };
  std::string text;
  for (const std::size_t node : deck.radial) text += "SPC1,1,13," + n(node) + "\n";
  for (const std::size_t node : deck.oblique) text += "SPC1,1,13," + n(node) + "\n";
  text += "SPC,1," + n(deck.held) + ",2,0.\nSPC1,1,12,9003\n";
  text += "CORD2C,1,0,0.5,0.2,0.,0.5,0.2,1.\n,0.7,0.2,0.\n";
  text += "CORD2R,2,0,0.,0.,0.,0.,0.,1.\n,0.6,0.8,0.\n";
  text += "GRID,9001,,0.03,0.,0.9\nGRID,9003,,0.5,0.,0.5\n";
  text += "RBE2,5,9001,123456";
  std::size_t field = 4;
  for (const std::size_t node : deck.top) {
    text += "," + n(node);
    if (++field == 9) text += "\n", field = 1;
  }
  text += "\nMPC,7," + n(deck.geared) + ",1,2.,9001,2,-1.\n,,9001,6,0.3\n";
  text += "CONM2,10,9001,,12.5\nCONM2,11," + n(deck.heavy) + ",,12.5\nCONM2,12,9003,,3.\n";
  text += "CELAS2,13,4.+8," + n(deck.sprung) + ",2\n";
  text += "CELAS2,14,2.+8," + n(deck.sprung) + ",1," + n(deck.heavy) + ",1\n";
  text += "CELAS2,16,5.+8," + n(deck.sprung) + ",3," + n(deck.above) + ",3\n";
  text += "MPC,7," + n(deck.geared) + ",3,1.," + n(deck.below) + ",3,-1.\n";
  text += "PELAS,3,3.+6\nCELAS1,15,3,9003,3," + n(deck.heavy) + ",3\n";
  return text;
}

std::string exact(double value) {
  std::ostringstream text;
  text.precision(17);
  text << value;
  return text.str();
}

/// Nodes and 8-node hexahedra of the .bdf in free fields of any width; nodes of the two edges have
/// axes of their own.
std::string bdf_of(const mesher::Mesh& mesh, const Deck& deck) {
  std::string text;
  const auto is_among = [](const std::vector<std::size_t>& numbers, std::size_t number) {
    return std::find(numbers.begin(), numbers.end(), number) != numbers.end();
  };
  for (std::size_t k = 0; k < mesh.nodes.size(); ++k) {
    const auto& x = mesh.nodes[k];
    const std::string axes = is_among(deck.radial, k + 1)    ? ",1"
                             : is_among(deck.oblique, k + 1) ? ",2"
                                                             : "";
    text += "GRID," + std::to_string(k + 1) + ",," + exact(x[0]) + "," + exact(x[1]) + "," +
            exact(x[2]) + axes + "\n";
  }
  const std::vector<std::int32_t>& nodes = mesh.blocks.front().nodes;
  for (std::size_t first = 0; first < nodes.size(); first += 8) {
    text += "CHEXA," + std::to_string(1 + first / 8) + ",1";
    for (std::size_t i = 0; i < 8; ++i) {
      if (i == 6) text += "\n";
      text += "," + std::to_string(nodes[first + i] + 1);
    }
    text += "\n";
  }
  return text;
}

Eigen::VectorXd frequencies_of(const mesher::Mesh& mesh) {
  ModalOptions options;
  options.mode_count = 8;
  options.formulation.of_others = Formulation::displacement;
  const ModalBody body = analyse_modes(mesh, options, {});
  CHECK(body.orthogonality < 1e-9);
  return body.frequencies_Hz;
}

/// Writes the mesh's own deck with the cards before its step.
std::filesystem::path write_deck(const TemporaryFolder& folder, const mesher::Mesh& mesh,
                                 const std::string& more = {}) {
  std::filesystem::path path = folder / "deck.inp";
  mesher::write_inp(path, mesh, {.reduced = {}, .fixed = {}, .mode_count = 8});
  std::string text = testing::bytes_of(path);
  text.insert(text.find("*STEP"), inp_cards(Deck(mesh)) + more);
  std::ofstream(path) << text;
  return path;
}

mesher::Mesh imported(const std::filesystem::path& file, const std::string& part) {
  mesher::ImportOptions options;
  options.file = file;
  if (!part.empty()) {
    options.materials = {kSteel};
    options.material_of_part[part] = kSteel.name;
  }
  std::string warnings;
  mesher::Mesh mesh =
      mesher::import_mesh(options, {}, [&](const std::string& line) { warnings += line; });
  CHECK(warnings.empty());
  return mesh;
}

}  // namespace

TEST_CASE("of a deck with supports, couplings, masses and springs CalculiX finds the same modes",
          "[ccx]") {
  constexpr double kSevenDigits = 1e-6;
  const TemporaryFolder folder;
  const std::filesystem::path deck = write_deck(folder, bar(mesher::ElementKind::hex20));
  const mesher::Mesh mesh = imported(deck, "");
  const Eigen::VectorXd found = frequencies_of(mesh);
  const std::vector<double> theirs = testing::calculix_frequencies(deck);
  REQUIRE(theirs.size() >= 8);
  for (std::size_t k = 0; k < 8; ++k) {
    CAPTURE(k, found[static_cast<Eigen::Index>(k)], theirs[k]);
    CHECK(std::abs(found[static_cast<Eigen::Index>(k)] / theirs[k] - 1) < kSevenDigits);
  }
  // The mesh file contains all of these connections.
  mesher::write_mesh(folder / "mesh.h5", {.mesh = mesh, .provenance = {}});
  const mesher::Mesh read = mesher::read_mesh(folder / "mesh.h5").mesh;
  CHECK(read.connections.text() == mesh.connections.text());
  CHECK(frequencies_of(read) == found);
}

TEST_CASE("a .bdf that says the same as an .inp gives the same modes") {
  constexpr double kSame = 1e-9;
  const TemporaryFolder folder;
  const mesher::Mesh mesh = bar(mesher::ElementKind::hex8);
  const Deck deck(mesh);
  std::ofstream(folder / "deck.bdf") << bdf_of(mesh, deck) << bdf_cards(deck) << "ENDDATA\n";
  // CalculiX chooses the dependent degrees of freedom itself, and refuses this MPC beside the
  // others.
  const std::string mpc =
      "*MPC\nBEAM," + std::to_string(deck.geared) + "," + std::to_string(deck.below) + "\n";
  const Eigen::VectorXd expected = frequencies_of(imported(write_deck(folder, mesh, mpc), ""));
  const Eigen::VectorXd found = frequencies_of(imported(folder / "deck.bdf", "volume_1"));
  CAPTURE(found.transpose(), expected.transpose());
  CHECK((found.array() / expected.array() - 1).abs().maxCoeff() < kSame);
}

}  // namespace flexneck::fe_modal
