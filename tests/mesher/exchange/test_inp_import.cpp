// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "mesher/mesh/mesh_measures.h"
#include "tests/mesher/exchange/files.h"

namespace flexneck::mesher {
namespace {

using Catch::Matchers::Contains;
using Catch::Matchers::EndsWith;
using testing::Files;
using testing::import_options;
using testing::warning_of_deck;

constexpr double kRounding = 1e-13;

/// Two boxes of 1 x 2 x 3 as C3D8, one above the other, with all features of a small deck. Units
/// mm, N, s; steel.
const char* const kDeck = R"(** a comment
*Heading
 two bricks
*Node, nset=All
1, 0, 0, 0
2, 1., 0, 0
3, 1.0E0, 2, 0
4, 0, 2.D0, 0
5, 0, 0, 3
6, 1, 0, 3
7, 1, 2, 3
8, 0, 2, 3
9, 0, 0, 6
10, 1, 0, 6
11, 1, 2, 6
12, 0, 2, 6
99, 5, 5, 5
*Element, type=C3D8,
  elset=Lower
1, 1, 2, 3, 4, 5, 6, 7, 8
*Element, type=C3D8I, elset=Upper
2, 5, 6, 7, 8, 9, 10, 11, 12
*Elset, elset=Both
LOWER, upper
*Nset, nset=Foot, generate
1, 4, 1
*Nset, nset=Ring
Foot, 9, 10,
11, 12
*Nset, nset=Reference
99
*Surface, name=Roof, type=element
2, s2
*Material, name=Steel
*Elastic
210000., 0.3
*Density
7.85e-9
*Solid Section, elset=Both, material=steel
*Boundary
Foot, 1, 2
foot, 3
*Step
*Frequency
5
*End Step
)";

std::string with(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

std::string refusal_of(const std::string& deck, const std::vector<std::string>& parts = {}) {
  const Files files;
  ImportOptions options = import_options(files.write("deck.inp", deck), parts);
  return testing::refusal(options);
}

}  // namespace

TEST_CASE("a deck gives parts, sets and materials in consistent units") {
  const Files files;
  ImportOptions options;
  options.file = files.write("deck.inp", kDeck);
  options.length_unit_m = 1e-3;
  std::string told;
  const Mesh mesh = import_mesh(options, [&](const std::string& line) { told += line + "\n"; });
  CHECK_THAT(told, Contains("ignored in deck.inp: *HEADING *STEP *FREQUENCY *END STEP"));

  REQUIRE(mesh.blocks.size() == 1);
  CHECK(mesh.blocks[0].part == "Both");
  CHECK(mesh.nodes.size() == 12);  // without the reference point
  CHECK(measure(mesh, mesh.blocks[0]).volume_m3 == Approx(12e-9).epsilon(kRounding));
  REQUIRE(mesh.materials.size() == 1);
  CHECK(mesh.materials[0].name == "Steel");
  CHECK(mesh.materials[0].youngs_modulus_Pa == Approx(210e9).epsilon(kRounding));
  CHECK(mesh.materials[0].density_kg_m3 == Approx(7850).epsilon(kRounding));

  CHECK(mesh.node_set("Foot").nodes == std::vector<std::int32_t>{0, 1, 2, 3});
  CHECK(mesh.node_set("boundary").nodes == mesh.node_set("Foot").nodes);
  CHECK(area_m2(mesh, mesh.face_set("Foot")) == Approx(2e-6).epsilon(kRounding));
  CHECK(mesh.node_set("Ring").nodes.size() == 8);
  CHECK(area_m2(mesh, mesh.face_set("Ring")) == Approx(4e-6).epsilon(kRounding));
  CHECK(area_m2(mesh, mesh.face_set("All")) == Approx((4 + 12 + 24) * 1e-6).epsilon(kRounding));
  CHECK(mesh.node_set("Roof").nodes == std::vector<std::int32_t>{8, 9, 10, 11});
  CHECK_THROWS_WITH(mesh.node_set("Reference"), Contains("no node set 'Reference'"));
}

TEST_CASE("inch and pound-force: a deck of steel in lbf s^2 / in^4") {
  const Files files;
  ImportOptions options;
  std::string deck = with(kDeck, "210000., 0.3", "30.457925e6, 0.3");
  options.file = files.write("deck.inp", with(deck, "7.85e-9", "7.3455e-4"));
  options.length_unit_m = 0.0254;
  options.force_unit_N = 4.4482216152605;
  const Mesh mesh = import_mesh(options, {});
  CHECK(mesh.materials[0].youngs_modulus_Pa == Approx(210e9).epsilon(1e-6));
  CHECK(mesh.materials[0].density_kg_m3 == Approx(7850).epsilon(1e-4));
}

TEST_CASE("the study's parts and materials go before the file's") {
  const Files files;
  const Mesh mesh = import_mesh(import_options(files.write("deck.inp", kDeck), {"upper"}), {});
  REQUIRE(mesh.blocks.size() == 2);
  CHECK(mesh.blocks[0].part == "upper");
  CHECK(mesh.materials[mesh.blocks[0].material].name == "stuff");
  CHECK(mesh.blocks[1].part == "Both");  // without the elements of other parts
  CHECK(mesh.blocks[1].size() == 1);
  CHECK(mesh.materials[mesh.blocks[1].material].name == "Steel");
}

TEST_CASE("a named support of solids holds all directions, as its numbers do") {
  const Files files;
  for (const char* const support : {"Foot, ENCASTRE\n", "foot, pinned\n", "Foot, 1, 6\n"}) {
    INFO(support);
    ImportOptions options;
    options.file = files.write("deck.inp", with(kDeck, "Foot, 1, 2\nfoot, 3\n", support));
    const Mesh mesh = import_mesh(options, {});
    CHECK(mesh.node_set("boundary").nodes == mesh.node_set("Foot").nodes);
  }
  ImportOptions options;
  options.file = files.write("deck.inp", with(kDeck, "Foot, 1, 2\nfoot, 3\n", "Foot, XSYMM\n"));
  const Mesh mesh = import_mesh(options, {});
  REQUIRE(mesh.connections.supports.size() == 1);
  CHECK(mesh.connections.supports[0].nodes == mesh.node_set("Foot").nodes);
  CHECK(mesh.connections.supports[0].directions == std::array<bool, 3>{true, false, false});
  CHECK_THROWS_WITH(mesh.node_set("boundary"), Contains("no node set 'boundary'"));
}

TEST_CASE("parts that are missing, doubled or without material are refused") {
  CHECK_THAT(refusal_of(kDeck, {"uper"}),
             Contains("there is no ELSET 'uper'") && Contains("did you mean 'Upper'"));
  CHECK_THAT(refusal_of(kDeck, {"upper", "Both"}), Contains("belongs to both parts"));
  CHECK_THAT(
      refusal_of(with(kDeck, "elset=Both, material=steel", "elset=Lower, material=steel")),
      Contains("1 elements belong to no part, the first is element 2") && Contains("'Upper'"));
  CHECK_THAT(
      refusal_of(with(kDeck, "material=steel", "material=steal")),
      Contains("material 'steal', which the file does not define") && Contains("mean 'Steel'"));
  CHECK_THAT(refusal_of(with(kDeck, "*Density\n7.85e-9\n", "")),
             Contains("material 'Steel' of the file has no *DENSITY"));
  CHECK_THAT(refusal_of(with(kDeck, "*Elastic\n", "*Elastic, type=ortho\n")),
             Contains("deck.inp:35: *ELASTIC: expected TYPE=ISO"));
}

TEST_CASE("elements of other types are refused with number, type and line") {
  const std::string deck = with(kDeck, "*Elset, elset=Both",
                                "*Element, type=S4\n3, 1, 2, 3, 4\n4, 5, 6,\n7, 8\n"
                                "*Element, type=C3D5\n5, 1, 2, 3, 4, 5\n*Elset, elset=Both");
  CHECK_THAT(refusal_of(deck), Contains("1 of type C3D5 (first at") &&
                                   Contains("2 of type S4 (first at") && Contains("deck.inp:23") &&
                                   Contains("supported are C3D8, C3D8I"));
}

TEST_CASE("what would change the structure is refused with its line, and so is what is misspelt") {
  const auto plus = [](const std::string& card) { return with(kDeck, "*Step", card + "*Step"); };
  CHECK_THAT(refusal_of(plus("*Tie, name=t\na, b\n")), Contains("deck.inp:43: *TIE: the keyword"));
  CHECK_THAT(refusal_of(plus("*Elemant, type=C3D8\n")), Contains("did you mean 'ELEMENT'"));
  CHECK_THAT(refusal_of(plus("*Instance, name=p, part=q\n")), Contains("noPartsInputFile=ON"));
  CHECK_THAT(refusal_of(plus("*Spring, elset=s, nonlinear\n1\n1.\n")),
             Contains("*SPRING: the parameter NONLINEAR is not supported"));
  CHECK_THAT(refusal_of(plus("*Spring, elset=s\n1\n1.\n")),
             Contains("*SPRING: there are no elements of this type in ELSET 's'"));
  CHECK_THAT(refusal_of(plus("*MPC\nPLANE, 1, 2\n")), Contains("expected PIN, TIE, LINK or BEAM"));
  CHECK_THAT(refusal_of(plus("*Equation\n2\n1, 1, 1., 5, 1\n")),
             Contains("expected 6 fields in line 45, found 5"));
  CHECK_THAT(refusal_of(plus("*Equation\n2\n1, 1, 1., 77, 1, -1.\n")),
             Contains("*EQUATION in line 44 has node 77, which the file does not define"));
  CHECK_THAT(refusal_of(plus("*Rigid Body, nset=Reference, ref node=99\n")),
             Contains("*RIGID BODY in line 43 has no nodes that belong to elements"));
  CHECK_THAT(refusal_of(plus("*Boundary\nFoot, 1, 3, 0.1\n")), Contains("displacements of zero"));
  CHECK_THAT(refusal_of(plus("*Boundary\nFot, 1, 3\n")),
             Contains("deck.inp:44: there is no NSET 'Fot' (did you mean 'Foot'?)"));
}

TEST_CASE("loads, preload, damping, loose nodes and other integrations are told in one line") {
  const auto plus = [](const std::string& cards) { return with(kDeck, "*Step", cards + "*Step"); };
  const std::string loads =
      "*Step\n*Static\n*Cload\nRing, 3, 1.\n*Cload\nFoot, 3, 1.\n*Dload\nBoth, P2, 1.\n*End Step\n";
  CHECK_THAT(warning_of_deck(plus(loads)),
             EndsWith("deck.inp: not carried over: 2 *CLOAD, 1 *DLOAD, 1 integration rules of "
                      "C3D8I (determined by modes.formulation), 1 nodes of no solid element, 1 of "
                      "them in NSET 'All', 1 of them in NSET 'Reference'; the preload of *STATIC "
                      "in line 44: modes are those of the unloaded structure\n"));
  CHECK_THAT(
      warning_of_deck(plus("*Initial Conditions, type=stress\nBoth, 1.\n*Damping, alpha=1\n")),
      Contains("1 *DAMPING, 1 *INITIAL CONDITIONS") && !Contains("preload"));
  CHECK_THAT(warning_of_deck(with(kDeck, "type=C3D8,", "type=C3D8R,")),
             Contains("1 integration rules of C3D8R"));
}

TEST_CASE("sets and supports of nodes that there are not are refused, but gaps in ranges counted") {
  CHECK_THAT(refusal_of(with(kDeck, "Foot, 9, 10,", "Foot, 9, 77,")),
             Contains("*NSET 'Ring' has node 77, which *NODE does not define"));
  CHECK_THAT(refusal_of(with(kDeck, "LOWER, upper", "LOWER, upper, 7")),
             Contains("*ELSET 'Both' has element 7, which *ELEMENT does not define"));
  CHECK_THAT(refusal_of(with(kDeck, "foot, 3", "foot, 3\n77, 1, 3")),
             Contains("*BOUNDARY fixes node 77, which *NODE does not define"));
  CHECK_THAT(warning_of_deck(with(kDeck, "99\n*Surface",
                                  "20, 99\n*Nset, nset=Gap, generate\n90, 99\n"
                                  "*Node\n20, 6, 6, 6\n*Surface")),
             Contains("9 nodes in the ranges of *NSET 'Gap', which *NODE does not define") &&
                 Contains("2 of them in NSET 'Reference'"));
  CHECK_THAT(refusal_of(with(kDeck, "*Step", "*Step\n*Boundary, op=new\nRing, 1, 3")),
             Contains("*BOUNDARY: OP=NEW removes the supports"));
  CHECK_THAT(refusal_of(with(kDeck, "nset=Reference\n99", "nset=Boundary\n9")),
             Contains("the NSET 'Boundary' has other nodes than the set of this name that is made "
                      "from *BOUNDARY"));
}

TEST_CASE("broken numbers and references are refused with their line") {
  CHECK_THAT(refusal_of(with(kDeck, "2, 1., 0, 0", "2, 1.x, 0, 0")),
             Contains("deck.inp:6: expected a number, found '1.x'"));
  CHECK_THAT(refusal_of(with(kDeck, "99, 5, 5, 5", "9, 5, 5, 5")),
             Contains("deck.inp:17: node 9 is defined twice"));
  CHECK_THAT(refusal_of(with(kDeck, "1, 1, 2, 3, 4, 5, 6, 7, 8", "1, 1, 2, 3, 4, 5, 6, 7")),
             Contains("deck.inp:20: expected a number and 8 nodes of a C3D8"));
  CHECK_THAT(refusal_of(with(kDeck, "2, 5, 6, 7, 8, 9", "2, 5, 6, 7, 8, 77")),
             Contains("element 2 has node 77, which *NODE does not define"));
  CHECK_THAT(refusal_of(with(kDeck, "2, 5, 6, 7, 8, 9", "1, 5, 6, 7, 8, 9")),
             Contains("element 1 is defined twice"));
  CHECK_THAT(refusal_of(with(kDeck, "2, s2", "2, s7")), Contains("its face S1 … S6"));
  CHECK_THAT(refusal_of("*ELEMENT, TYPE=C3D8\n"),
             Contains("deck.inp: expected at least one *ELEMENT"));
}

TEST_CASE("included files are followed within the folder only") {
  const Files files;
  const std::string deck = kDeck;
  const std::size_t begin = deck.find("1, 0, 0, 0");
  const std::size_t end = deck.find("*Element");
  files.write("nodes.inp", deck.substr(begin, end - begin));
  const auto include = [&](const std::string& name) {
    return files.write("main.inp",
                       deck.substr(0, begin) + "*Include, input=" + name + "\n" + deck.substr(end));
  };
  ImportOptions options;
  options.file = include("nodes.inp");
  CHECK(import_mesh(options, {}).nodes.size() == 12);
  for (const char* const name : {"/etc/hostname", "../nodes.inp", "a/../../nodes.inp"}) {
    INFO(name);
    options.file = include(name);
    CHECK_THAT(testing::refusal(options),
               Contains("main.inp:5: *INCLUDE") && Contains("outside the folder"));
  }
  options.file = include("none.inp");
  CHECK_THAT(testing::refusal(options), Contains("there is no file none.inp"));
  options.file = include("main.inp");
  CHECK_THAT(testing::refusal(options), Contains("include each other"));
  options.file = include(std::string(300, 'n'));
  CHECK_THAT(testing::refusal(options), Contains("*INCLUDE") && Contains("cannot be read"));
}

TEST_CASE("ranges of sets are refused before they take the memory") {
  std::string deck = "*ELSET, ELSET=a, GENERATE\n";
  for (int k = 0; k < 200; ++k) deck += "1, 10000000\n";
  CHECK_THAT(refusal_of(deck), Contains("numbers in all sets"));
}

TEST_CASE("files that include the next one often are refused before the hours") {
  const Files files;
  for (int k = 0; k < 7; ++k) {
    std::string lines;
    for (int often = 0; often < 20; ++often)
      lines += "*INCLUDE, INPUT=" + std::to_string(k + 1) + ".inp\n";
    files.write(std::to_string(k) + ".inp", lines);
  }
  files.write("7.inp", "*NODE\n1, 0, 0, 0\n");
  ImportOptions options;
  options.file = files.write("main.inp", "*INCLUDE, INPUT=0.inp\n");
  CHECK_THAT(testing::refusal(options), Contains("more than 1000 files"));
}

TEST_CASE("other files, supports of later steps and masses by direction are refused by name") {
  const Files files;
  const auto refusal_of = [&](const std::string& more) {
    return testing::refusal(
        import_options(files.write("deck.inp", std::string(kDeck) + more), {"Both"}));
  };
  for (const std::string keyword :
       {"*NODE", "*ELEMENT, TYPE=C3D8", "*EQUATION", "*BOUNDARY", "*NSET, NSET=more"}) {
    INFO(keyword);
    CHECK_THAT(refusal_of(keyword + ", INPUT=more.txt\n"), Contains("INPUT= is not supported"));
  }
  CHECK_THAT(refusal_of("*ELEMENT, TYPE=MASS, ELSET=M\n99, 7\n*MASS, ELSET=M, TYPE=ANISOTROPIC\n"
                        "1., 2., 3.\n"),
             Contains("*MASS: expected TYPE=ISOTROPIC, found TYPE=ANISOTROPIC"));
  CHECK_THAT(refusal_of("*STEP\n*FREQUENCY\n4\n*END STEP\n*STEP\n*STATIC\n*BOUNDARY\nRing, 1, 3\n"
                        "*END STEP\n"),
             Contains("it belongs to a step after the *FREQUENCY"));
}

TEST_CASE("an NSET means its nodes, and faces that cover others under its name are refused") {
  const Files files;
  const auto mesh_of = [&](const std::string& more) {
    return import_mesh(
        import_options(files.write("deck.inp", with(kDeck, "*Material", more + "*Material")), {}),
        {});
  };
  const std::string both_counts = "the node set 'Mine' has 5 nodes";
  const Mesh partial = mesh_of("*Nset, nset=Mine\n1, 2, 3, 4, 9\n");
  CHECK(partial.node_set("Mine").nodes == std::vector<std::int32_t>{0, 1, 2, 3, 8});
  CHECK_THROWS_WITH(
      partial.face_set("Mine"),
      Contains("there is no face set 'Mine': the node set of that name has 5 nodes, of which "
               "whole faces of the surface cover 4"));
  for (const std::string name : {"Mine", "MINE"}) {
    const Mesh two = mesh_of("*Nset, nset=Mine\n1, 2, 3, 4, 9\n*Surface, name=" + name +
                             ", type=element\n1, s1\n");
    CHECK_THROWS_WITH(two.node_set("Mine"), Contains(both_counts) && Contains("covers 4 nodes"));
    CHECK_THROWS_WITH(two.face_set("Mine"), Contains(both_counts) && Contains("covers 4 nodes"));
  }
  const Mesh same = mesh_of("*Nset, nset=Mine\n1, 2, 3, 4\n*Surface, name=mine\n1, s1\n");
  CHECK(same.node_set("Mine").nodes == nodes_of(same.face_set("Mine")).nodes);
}

TEST_CASE("a mark of UTF-8 at the beginning of a deck is passed over") {
  const Files files;
  const std::string mark = "\xef\xbb\xbf";
  CHECK(testing::refusal(import_options(files.write("deck.inp", mark + kDeck), {})) == "accepted");
  CHECK(testing::refusal(import_options(files.write("one.msh", mark + testing::kTetrahedronMsh),
                                        {"corner"})) == "accepted");
}

}  // namespace flexneck::mesher
