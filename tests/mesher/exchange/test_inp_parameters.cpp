// SPDX-License-Identifier: GPL-3.0-or-later
// Every parameter of a keyword in Abaqus and CalculiX is obeyed, has no effect, or is refused by
// name.
#include <set>

#include <catch2/catch.hpp>

#include "mesher/exchange/inp_keywords.h"
#include "tests/mesher/exchange/files.h"

namespace flexneck::mesher {
namespace {

using Catch::Matchers::Contains;
using testing::Files;
using testing::import_options;

/// A brick with a line of every keyword that is read.
const char* const kAllKeywords = R"(*NODE
1, 0, 0, 0
2, 1, 0, 0
3, 1, 2, 0
4, 0, 2, 0
5, 0, 0, 3
6, 1, 0, 3
7, 1, 2, 3
8, 0, 2, 3
99, 5, 5, 5
*ELEMENT, TYPE=C3D8, ELSET=BRICK
1, 1, 2, 3, 4, 5, 6, 7, 8
*ELEMENT, TYPE=MASS, ELSET=HEAVY
2, 6
*ELEMENT, TYPE=SPRING1, ELSET=SOFT
3, 6
*ELSET, ELSET=WHOLE
1
*NSET, NSET=FOOT
1, 2, 3, 4
*NSET, NSET=EDGE
5
*NSET, NSET=RIGID
7, 8
*SURFACE, NAME=ROOF
1, S2
*MATERIAL, NAME=STEEL
*ELASTIC
210000., 0.3
*DENSITY
7.85E-9
*SOLID SECTION, ELSET=WHOLE, MATERIAL=STEEL
*MASS, ELSET=HEAVY
1.
*SPRING, ELSET=SOFT
1
1.
*TRANSFORM, NSET=EDGE
1., 0., 0., 0., 1., 0.
*BOUNDARY
FOOT, 1, 3
*EQUATION
2
7, 1, 1., 8, 1, -1.
*MPC
PIN, 6, 3
*RIGID BODY, NSET=RIGID, REF NODE=99
*STEP
*FREQUENCY
5
*RESTART
*OUTPUT
*END STEP
)";

/// All parameters in the keyword references of Abaqus and CalculiX of the keywords that are read.
const std::set<std::string> kDocumented = {"ALPHA",
                                           "AMPLITUDE",
                                           "ANALYTICAL SURFACE",
                                           "BASE NAME",
                                           "BLADE",
                                           "COMBINE",
                                           "COMPLEX STIFFNESS",
                                           "COMPOSITE",
                                           "COMPRESSION FACTOR",
                                           "CONTROLS",
                                           "CROP",
                                           "DEPENDENCIES",
                                           "DISTRIBUTION",
                                           "ELSET",
                                           "FILE",
                                           "FILLET RADIUS",
                                           "FIXED",
                                           "GENERATE",
                                           "GLOBAL STEP",
                                           "INC",
                                           "INSTANCE",
                                           "INTERNAL",
                                           "ISOTHERMAL",
                                           "LAYUP",
                                           "LOAD CASE",
                                           "MASSFLOW",
                                           "MATERIAL",
                                           "MAX RATIO",
                                           "MODE",
                                           "MODULI",
                                           "NAME",
                                           "NLGEOM",
                                           "NODAL THICKNESS",
                                           "NONLINEAR",
                                           "NSET",
                                           "OFFSET",
                                           "OP",
                                           "ORDER",
                                           "ORIENTATION",
                                           "PIN NSET",
                                           "POISSON",
                                           "PORE FLUID",
                                           "POSITION",
                                           "READ",
                                           "REF NODE",
                                           "REGION TYPE",
                                           "REMOVE",
                                           "ROT NODE",
                                           "RTOL",
                                           "SCALE",
                                           "SHELL THICKNESS",
                                           "SOLID ELEMENT NUMBERING",
                                           "STACK DIRECTION",
                                           "STEP",
                                           "SUBMODEL",
                                           "SYMMETRIC",
                                           "SYSTEM",
                                           "TIE NSET",
                                           "TIME DELAY",
                                           "TRIM",
                                           "TYPE",
                                           "UNSORTED",
                                           "USER",
                                           "WRITE"};

std::string line_of(const std::string& keyword) {
  const std::string deck = kAllKeywords;
  const std::size_t begin = deck.find("*" + keyword);
  return deck.substr(begin, deck.find('\n', begin) - begin);
}

std::string with_line(const std::string& keyword, const std::string& line) {
  std::string deck = kAllKeywords;
  const std::string old = line_of(keyword);
  return deck.replace(deck.find(old), old.size(), line);
}

struct ParameterReader {
  Files files;
  Mesh read(const std::string& deck) {
    return import_mesh(import_options(files.write("deck.inp", deck), {}), {});
  }
  std::string refusal(const std::string& deck) {
    return testing::refusal(import_options(files.write("deck.inp", deck), {}));
  }
};

bool is_same(const Mesh& one, const Mesh& other) {
  if (one.node_sets.size() != other.node_sets.size()) return false;
  for (std::size_t k = 0; k < one.node_sets.size(); ++k) {
    if (one.node_sets[k].nodes != other.node_sets[k].nodes) return false;
  }
  const Connections& a = one.connections;
  const Connections& b = other.connections;
  return one.nodes == other.nodes && a.supports.size() == b.supports.size() &&
         a.equations.size() == b.equations.size() && a.couplings.size() == b.couplings.size() &&
         a.masses.size() == b.masses.size() && a.springs.size() == b.springs.size();
}

}  // namespace

TEST_CASE("each documented parameter of a keyword is obeyed, changes nothing, or is refused") {
  ParameterReader reader;
  const Mesh plain = reader.read(kAllKeywords);
  for (const auto& [keyword, row] : inp_keywords()) {
    if (row.use != InpUse::read && keyword != "RESTART") continue;
    const std::string line = line_of(keyword);
    std::set<std::string> unknown = kDocumented;
    for (const InpParameter& parameter : row.parameters) {
      unknown.erase(parameter.name);
      if (parameter.no_effect.empty()) continue;
      CAPTURE(keyword, parameter.name);
      CHECK(is_same(reader.read(with_line(keyword, line + ", " + parameter.name)), plain));
    }
    for (const std::string& parameter : unknown) {
      for (const std::string value : {"", "=1"}) {
        CHECK_THAT(reader.refusal(with_line(keyword, line + ", " + parameter + value)),
                   Contains("*" + keyword + ": the parameter " + parameter + " is not supported"));
      }
    }
  }
}

TEST_CASE("values of parameters that are obeyed otherwise than read are refused by name") {
  ParameterReader reader;
  const auto refusal = [&](const std::string& keyword, const std::string& more) {
    return reader.refusal(with_line(keyword, line_of(keyword) + ", " + more));
  };
  CHECK_THAT(refusal("NODE", "SYSTEM=C"), Contains("expected SYSTEM=R, found SYSTEM=C"));
  CHECK_THAT(refusal("SURFACE", "TYPE=NODE"), Contains("expected TYPE=ELEMENT, found TYPE=NODE"));
  CHECK_THAT(refusal("ELASTIC", "TYPE=ENGINEERING CONSTANTS"), Contains("ISO or ISOTROPIC"));
  CHECK_THAT(refusal("BOUNDARY", "TYPE=VELOCITY"), Contains("expected TYPE=DISPLACEMENT"));
  CHECK_THAT(refusal("BOUNDARY", "OP=NEXT"), Contains("expected OP=MOD or NEW"));
  CHECK_THAT(refusal("TRANSFORM", "TYPE=S"), Contains("expected TYPE=R or C"));
  CHECK_THAT(refusal("RIGID BODY", "POSITION=CENTER OF MASS"), Contains("POSITION=INPUT"));
  CHECK_THAT(refusal("NSET", "GENERATE=NO"), Contains("GENERATE takes no value"));
  CHECK_THAT(refusal("NSET", "GEN"), Contains("the parameter GEN is not supported"));
  CHECK_THAT(refusal("NSET", "NSET=OTHER"), Contains("NSET is given twice"));
  CHECK_THAT(reader.refusal(with_line("RIGID BODY", "*RIGID BODY, NSET=RIGID, REF  NODE=99")),
             Contains("accepted"));
}

}  // namespace flexneck::mesher
