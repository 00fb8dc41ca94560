// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "mesher/exchange/inp_cards.h"
#include "mesher/mesh/mesh_measures.h"
#include "tests/mesher/exchange/files.h"

namespace flexneck::mesher {
namespace {

using Catch::Matchers::Contains;
using Catch::Matchers::EndsWith;
using testing::Files;
using testing::import_options;

/// Two unit cubes, one above the other, in fixed fields.
const char* const kBulk = R"(GRID           1              0.      0.      0.
GRID           2              1.      0.      0.
GRID           3              1.      1.      0.
GRID           4              0.      1.      0.
GRID           5              0.      0.      1.
GRID           6              1.      0.      1.
GRID           7              1.      1.      1.
GRID           8              0.      1.      1.
GRID           9              0.      0.      2.
GRID          10              1.      0.      2.
GRID          11              1.      1.      2.
GRID          12              0.      1.      2.
CHEXA          1       1       1       2       3       4       5       6+
+              7       8
CHEXA          2       1       5       6       7       8       9      10+
+             11      12
)";

std::string deck(const std::string& more) {
  return "SOL 103\nCEND\nSPC = 1\nBEGIN BULK\n" + std::string(kBulk) + more + "ENDDATA\nFORCE,1\n";
}

ImportOptions options_of(const Files& files, const std::string& name, const std::string& text) {
  return import_options(files.write(name, text), {"volume_1"});
}

std::string warning_of(const std::string& bdf) {
  const Files files;
  return testing::warnings_of(options_of(files, "deck.bdf", bdf));
}

std::string warning_without(const std::string& bdf, const std::vector<std::string>& kinds) {
  const Files files;
  ImportOptions options = options_of(files, "deck.bdf", bdf);
  options.leave_out = kinds;
  return testing::warnings_of(options);
}

std::string nastran_refusal(const std::string& bdf) {
  const Files files;
  return testing::refusal(options_of(files, "deck.bdf", bdf));
}

}  // namespace

TEST_CASE(
    "cards of a .bdf that a mesh cannot hold are counted in one line, in every field format") {
  CHECK(warning_of(deck("MAT1,1,2.+11,,.3,7850.\nPSOLID,1,1\nEIGRL,1,,,6\n$ CONM2,1\n")).empty());
  CHECK_THAT(warning_without(deck(R"(CONM2         21       9               5.0
CONM2,22,10,,5.
SPC1,1,123,1,2,3,4
RBE2          23       9  123456      10      11      12       1       2+
+              3       4
CELAS2*               24          1000.0               9               3
*                     10               3
cquad4,25,2,1,2,3,4
PSHELL,2,1,.01
RBE3,26,,9,123,1.,123,10,11,
,12,123
MPC,1,9,1,1.,10,1,-1.
FORCE,1,9,,1.,0.,0.,1. $ a comment
PLOAD4,1,2,1.
GRID,30,,3.,3.,3.,,3
PARAM,WTMASS,.00259
PARAM,POST,-1
)"),
                             {"CQUAD4", "RBE3"}),
             EndsWith("deck.bdf: not carried over: 1 CQUAD4, 1 FORCE, 1 MPC of sets that are not "
                      "selected, 1 PLOAD4, 1 RBE3, 1 nodes of no solid element, 1 supports of "
                      "nodes of no solid element; PARAM,WTMASS .00259: the densities of the deck "
                      "are weight densities, the study needs mass densities\n"));
}

TEST_CASE("a .bdf that gmsh would read as another structure is refused with its line") {
  CHECK_THAT(nastran_refusal(deck("GRID,30,2,0.,0.,0.\n")),
             Contains("deck.bdf: line 21: GRID: coordinates in system 2 are not supported"));
  CHECK_THAT(nastran_refusal(deck("GRDSET,,2\n")), Contains("GRDSET: coordinates in system 2"));
  CHECK_THAT(nastran_refusal(deck("INCLUDE 'more.bdf'\n")),
             Contains("is not supported; write the deck as a single file"));
  CHECK_THAT(nastran_refusal(deck("GRID,30,,0.,0.,3.\n=,*(1),=,*(1.),==\n=3\n")),
             Contains("line 22: =: replicated cards"));
  CHECK_THAT(nastran_refusal(deck("GRID\t30\t\t0.\t0.\t3.\n")),
             Contains("GRID: tabs between fixed"));
  CHECK_THAT(nastran_refusal(deck("CHEXA,3,1,1,2,3,4,5,6\n,7,8,9\n")),
             Contains("CHEXA: expected 8 or 20 nodes, found 9"));
  CHECK_THAT(nastran_refusal(deck("SPC1,1,123,1,2,3,4,5,6,7,8\n")),
             Contains("line 21: SPC1: expected at most 8 free fields"));
  CHECK_THAT(
      nastran_refusal("SUBCASE 1\nSPC=1\nSUBCASE 2\nSPC=2\nBEGIN BULK\n" + std::string(kBulk)),
      Contains("SUBCASE 1 has SPC = 1, SUBCASE 2 has SPC = 2"));
  CHECK_THAT(nastran_refusal(deck("+A1,1,2\n")), Contains("the mark '+A1'"));
}

namespace {

std::string data_set(int number, const std::string& lines) {
  return "    -1\n" + std::to_string(number) + "\n" + lines + "    -1\n";
}

/// A unit cube, with more elements if given.
std::string unv(const std::string& more_elements = "") {
  std::string nodes;
  const std::array<const char*, 8> places = {"0. 0. 0.", "1. 0. 0.", "1. 1. 0.", "0. 1. 0.",
                                             "0. 0. 1.", "1. 0. 1.", "1. 1. 1.", "0. 1. 1."};
  for (std::size_t n = 0; n < places.size(); ++n) {
    nodes += "         " + std::to_string(n + 1) + " 1 1 11\n " + places[n] + "\n";
  }
  return data_set(2411, nodes) +
         data_set(2412,
                  "         1       115         1         1         7         8\n"
                  "         1         2         3         4         5         6         7"
                  "         8\n" +
                      more_elements);
}

std::string unv_warning_of(const std::string& text) {
  const Files files;
  return testing::warnings_of(options_of(files, "cube.unv", text));
}

}  // namespace

TEST_CASE("cards that change the structure are refused unless the study names them") {
  for (const std::string card :
       {"RBAR,26,9,10,123456", "RBE3,26,,9,123,1.,123,10,11", "CBUSH,26,1,9,10",
        "NSM1,26,PSOLID,,1.,1", "CBAR,26,1,9,10", "CMASS2,26,1.,9,1", "rrod,26,9,10"}) {
    INFO(card);
    const Files files;
    ImportOptions options = options_of(files, "deck.bdf", deck(card + "\n"));
    const std::string name = upper_case(std::string_view(card).substr(0, card.find(',')));
    CHECK_THAT(testing::refusal(options),
               Contains("1 " + name + " (first in line 21)") && Contains("geometry.leave_out"));
    options.leave_out = {name};
    CHECK_THAT(testing::warnings_of(options), EndsWith("not carried over: 1 " + name + "\n"));
    options.leave_out.push_back("CGAP");
    CHECK_THAT(testing::refusal(options),
               Contains("names 'CGAP', but the file has no unsupported cards of that kind"));
  }
}

TEST_CASE("restraints, springs and shells of a .unv are counted, and its unit is compared") {
  const std::string spring =
      "         2       136         2         1         7         2\n"
      "         1         7\n";
  const std::string shell =
      "         3        94         2         1         7         4\n"
      "         1         2         3         4\n";
  CHECK(unv_warning_of(unv()).empty());
  CHECK(unv_warning_of(unv(shell) + data_set(164, " 1 SI 2\n 1.0D+00 1.0D+00 1.0D+00\n")).empty());
  CHECK_THAT(
      unv_warning_of(unv(spring + shell) + data_set(755, " 1\n") + data_set(755, " 2\n") +
                     data_set(2437, " 2 1\n") +
                     data_set(164, " 5 mm 2\n 1.0D+03 1.0D+03 1.0D+00\n")),
      EndsWith(
          "cube.unv: not carried over: 2 data set 755, 1 elements of descriptor 136, 1 shells; "
          "data set 164 gives 1000 length units per metre, but the unit of the study is 1\n"));
}

TEST_CASE("groups of a .unv are parts, face sets and node sets, whichever data set has them") {
  const std::string shell =
      "         3        94         2         9         7         4\n"
      "         1         2         3         4\n";
  const auto group = [](const std::string& name, const std::string& members, int count) {
    return "         4 0 0 0 0 0 0 " + std::to_string(count) + "\n" + name + "\n" + members + "\n";
  };
  for (const int number : {2435, 2452, 2467, 2477}) {
    INFO(number);
    const Files files;
    const std::string text =
        unv(shell) +
        data_set(number, group("BAR", " 8 1 0 0", 1) + group("FOOT", " 8 3 0 0 7 8 0 0", 2) +
                             group("TIP", " 7 7 0 0 7 6 0 0", 2));
    const auto file = files.write("cube.unv", text);
    const Mesh mesh = import_mesh(import_options(file, {"BAR"}), {});
    CHECK(mesh.blocks.at(0).part == "BAR");
    CHECK(mesh.node_set("TIP").nodes == std::vector<std::int32_t>{5, 6});
    CHECK_THROWS_WITH(mesh.face_set("FOOT"), Contains("has 5 nodes") && Contains("covers 4 nodes"));
    CHECK(import_mesh(import_options(file, {"volume_1"}), {}).blocks.at(0).part == "volume_1");
    CHECK_THAT(testing::refusal(import_options(file, {"BAAR"})),
               Contains("there is no part 'BAAR'") && Contains("did you mean 'BAR'"));
  }
  const Files files;
  const std::string twice =
      unv() + data_set(2467, group("ONE", " 8 1 0 0", 1) + group("TWO", " 8 1 0 0", 1));
  CHECK_THAT(testing::refusal(import_options(files.write("cube.unv", twice), {"ONE", "TWO"})),
             Contains("element 1 belongs to both parts 'ONE' and 'TWO'"));
}

TEST_CASE("20-node hexahedra of a .bdf are one, however their lines continue") {
  const Files files;
  std::string grids;
  const auto nodes = reference_nodes(ElementKind::hex20);
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    grids += "GRID," + std::to_string(n + 1);
    for (const double& x : nodes[n])
      grids += (&x == nodes[n].data() ? ",," : ",") + std::to_string(x);
    grids += "\n";
  }
  // Node numbers of this program in the order of Nastran: lower, rising and upper edges.
  const std::array<int, 20> order = {1,  2,  3,  4,  5,  6,  7,  8,  9,  12,
                                     14, 10, 11, 13, 15, 16, 17, 19, 20, 18};
  const auto fixed = [&](std::size_t first, std::size_t count, std::size_t width) {
    std::string text;
    for (std::size_t k = first; k < first + count; ++k) {
      const std::string number = std::to_string(order.at(k));
      text += std::string(width - number.size(), ' ') + number;
    }
    return text;
  };
  const std::string small = "CHEXA          1       1" + fixed(0, 6, 8);
  const std::string blank = small + "\n        " + fixed(6, 8, 8) + "\n        " + fixed(14, 6, 8);
  const std::string marks = "+B2     " + fixed(14, 6, 8) + "\n" + small + "+B1\n" +
                            "PSOLID,1,1\n+B1     " + fixed(6, 8, 8) + "+B2";
  const std::string wide = "chexa*  " + std::string(15, ' ') + "1" + std::string(15, ' ') + "1" +
                           fixed(0, 2, 16) + "\n*       " + fixed(2, 4, 16) + "\n*       " +
                           fixed(6, 4, 16) + "\n*       " + fixed(10, 4, 16) + "\n*       " +
                           fixed(14, 4, 16) + "\n*       " + fixed(18, 2, 16);
  for (const std::string& card : {blank, marks, wide}) {
    INFO(card);
    const auto file = files.write("one.bdf", grids + card + "\nENDDATA\n");
    const Mesh mesh = import_mesh(import_options(file, {"volume_1"}), {});
    REQUIRE(mesh.blocks.at(0).kind == ElementKind::hex20);
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      CHECK(mesh.blocks[0].nodes[n] == static_cast<std::int32_t>(n));
    }
    CHECK(measure(mesh, mesh.blocks[0]).volume_m3 == Approx(8).epsilon(1e-12));
  }
}

TEST_CASE("what a .msh has beside its solids is counted: curves and surfaces, nodes of nothing") {
  const Files files;
  std::string mesh = testing::kTetrahedronMsh;
  CHECK(testing::warnings_of(import_options(files.write("sound.msh", mesh), {"corner"})).empty());
  mesh.replace(mesh.find("$Nodes\n10\n"), 10, "$Nodes\n12\n");
  mesh.replace(mesh.find("$EndNodes"), 0, "11 2 0 0\n12 2 2 0\n");
  const std::string nodes = mesh.substr(0, mesh.find("1\n1 11 2"));
  const std::string solid = "11 2 7 1 1 2 3 4 5 6 7 8 9 10\n";
  const auto text_of = [&](const std::string& last) {
    return nodes + "5\n1 " + solid + "2 1 2 0 2 1 2\n3 1 2 0 2 2 11\n4 2 2 0 3 2 11 12\n5 " + last +
           "$EndElements\n";
  };
  const auto options_of_msh = [&](const std::string& text) {
    return import_options(files.write("more.msh", text), {"corner"});
  };
  CHECK_THAT(testing::warnings_of(options_of_msh(text_of("9 2 8 4 1 3 2 7 6 5\n"))),
             EndsWith("more.msh: not carried over: 1 elements of type 'Line 2' that are not part "
                      "of solids, 1 elements of type 'Triangle 3' that are not part of solids\n"));
  CHECK_THAT(testing::refusal(options_of_msh(text_of("11 2 0 2 1 2 3 4 5 6 7 8 9 10\n"))),
             Contains("volume 2 belongs to 0 physical volumes, expected one"));
  CHECK_THAT(testing::warnings_of(options_of_msh(R"($MeshFormat
4.1 0 8
$EndMeshFormat
$PhysicalNames
1
3 7 "corner"
$EndPhysicalNames
$Entities
0 0 0 1
1 0 0 0 1 1 1 1 7 0
$EndEntities
$Nodes
1 11 1 11
3 1 0 11
1
2
3
4
5
6
7
8
9
10
11
0 0 0
1 0 0
0 1 0
0 0 1
0.5 0 0
0.5 0.5 0
0 0.5 0
0 0 0.5
0 0.5 0.5
0.5 0 0.5
5 5 5
$EndNodes
$Elements
1 1 1 1
3 1 11 1
1 1 2 3 4 5 6 7 8 9 10
$EndElements
)")),
             EndsWith("more.msh: not carried over: 1 nodes that belong to no element\n"));
}

}  // namespace flexneck::mesher
