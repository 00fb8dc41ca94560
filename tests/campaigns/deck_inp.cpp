// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <map>

#include "tests/campaigns/deck.h"
#include "tests/campaigns/deck_fields.h"

namespace flexneck::campaigns {
namespace {

/// Writes Abaqus input: keyword lines and lines of data, with blanks, comments and both cases.
class InpText {
 public:
  explicit InpText(Case& drawn) : drawn_(drawn) {}

  void keyword(const std::vector<std::string>& parts) {
    note();
    text += "*";
    for (std::size_t k = 0; k < parts.size(); ++k) {
      text += (k > 0 ? blank() : "") + cased(drawn_, parts[k]);
      if (k + 1 == parts.size()) break;
      text += blank() + ",";
      if (drawn_.chance(0.2)) text += "\n";
    }
    text += "\n";
  }
  void data(const std::vector<std::string>& fields, std::size_t per_line = 16) {
    note();
    for (std::size_t k = 0; k < fields.size(); ++k) {
      text += blank() + fields[k];
      if (k + 1 < fields.size()) text += blank() + ",";
      if (k + 1 == fields.size() || (k + 1) % per_line == 0) text += "\n";
    }
  }

  std::string text;

 private:
  std::string blank() { return drawn_.chance(0.2) ? " " : ""; }
  void note() {
    if (drawn_.chance(0.1)) text += "** *BOUNDARY, a comment\n";
  }
  Case& drawn_;
};

void add_inp_set(Case& drawn, const Deck& deck, const std::string& name,
                 const std::vector<std::size_t>& nodes, InpText& out) {
  if (deck.number_step == 0 || drawn.chance(0.4)) {
    out.keyword({"NSET", "NSET=" + name});
    out.data(numbers_of(deck, nodes));
    return;
  }
  out.keyword({"NSET", "NSET=" + name, "GENERATE"});
  for (std::size_t k = 0, end = 0; k < nodes.size(); k = end) {
    for (end = k + 1; end < nodes.size() && nodes[end] == nodes[end - 1] + 1;) ++end;
    out.data({std::to_string(deck.numbers[nodes[k]]), std::to_string(deck.numbers[nodes[end - 1]]),
              std::to_string(deck.number_step)});
  }
}

/// Writes nodes, in a file of their own or not, and elements.
void add_mesh(Case& drawn, const Deck& deck, const std::filesystem::path& file, InpText& out) {
  const Orders& orders = orders_of(deck.kind);
  InpText nodes(drawn);
  nodes.keyword({"NODE", "NSET=all"});
  for (const std::size_t node : shuffled(drawn, deck.places.size())) {
    const Eigen::Vector3d& x = deck.places[node];
    nodes.data({std::to_string(deck.numbers[node]), coordinate(drawn, x[0], false),
                coordinate(drawn, x[1], false), coordinate(drawn, x[2], false)});
  }
  if (drawn.chance(0.3)) {
    save(file.parent_path() / "nodes.inc", nodes.text);
    out.text += "*INCLUDE, INPUT=nodes.inc\n";
  } else {
    out.text += nodes.text;
  }
  out.keyword({"ELEMENT", std::string("TYPE=") + orders.abaqus_type, "ELSET=solid"});
  for (const std::size_t e : shuffled(drawn, deck.elements.size())) {
    std::vector<std::string> fields = element_fields(deck, e, orders.abaqus);
    fields.insert(fields.begin(), std::to_string(deck.element_numbers[e]));
    out.data(fields, static_cast<std::size_t>(drawn.whole(5, 16)));
  }
}

void add_material(Case& drawn, const Deck& deck, InpText& out) {
  out.keyword({"MATERIAL", "NAME=stuff"});
  out.keyword(drawn.chance(0.5) ? std::vector<std::string>{"ELASTIC"}
                                : std::vector<std::string>{"ELASTIC", "TYPE=ISO"});
  out.data({value_text(deck.youngs_modulus), value_text(deck.poissons_ratio)});
  out.keyword({"DENSITY"});
  out.data({value_text(deck.density)});
  out.keyword({"SOLID SECTION", "MATERIAL=stuff", "ELSET=solid"});
}

/// Writes the axes of nodes that have their own.
void add_axes(Case& drawn, const Deck& deck, InpText& out) {
  int next = 0;
  for (const DeckAxes& axes : deck.axes) {
    const std::string name = "turned" + std::to_string(++next);
    add_inp_set(drawn, deck, name, axes.nodes, out);
    const Eigen::Matrix3d frame = axes.frame();
    const Eigen::Vector3d one = axes.is_cylindrical ? axes.origin : frame.col(0);
    const Eigen::Vector3d other =
        axes.is_cylindrical ? axes.on_z : Eigen::Vector3d(frame.col(0) + 2 * frame.col(1));
    out.keyword({"TRANSFORM", "NSET=" + name, axes.is_cylindrical ? "TYPE=C" : "TYPE=R"});
    std::vector<std::string> fields;
    for (const Eigen::Vector3d& v : {one, other})
      for (const double x : v) fields.push_back(printed("%.15E", x));
    out.data(fields);
  }
}

/// Writes couplings, masses, springs, equations and pins.
void add_connections(Case& drawn, const Deck& deck, InpText& out) {
  for (const Deck::Coupling& coupling : deck.couplings) {
    add_inp_set(drawn, deck, "rigid", coupling.nodes, out);
    out.keyword(
        {"RIGID BODY", "NSET=rigid", "REF NODE=" + std::to_string(deck.numbers[coupling.point])});
  }
  int elements = 900000;
  for (const Deck::Mass& mass : deck.masses) {
    const std::string set = "mass" + std::to_string(++elements);
    out.keyword({"ELEMENT", "TYPE=MASS", "ELSET=" + set});
    out.data({std::to_string(elements), std::to_string(deck.numbers[mass.node])});
    out.keyword({"MASS", "ELSET=" + set});
    out.data({value_text(mass.mass)});
  }
  for (const Deck::Spring& spring : deck.springs) {
    const std::string set = "spring" + std::to_string(++elements);
    out.keyword({"ELEMENT", "ELSET=" + set, spring.has_other ? "TYPE=SPRING2" : "TYPE=SPRING1"});
    std::vector<std::string> ends = {std::to_string(elements),
                                     std::to_string(deck.numbers[spring.one.node])};
    std::vector<std::string> components = {std::to_string(spring.one.component)};
    if (spring.has_other) {
      ends.push_back(std::to_string(deck.numbers[spring.other.node]));
      components.push_back(std::to_string(spring.other.component));
    }
    out.data(ends);
    out.keyword({"SPRING", "ELSET=" + set});
    out.data(components);
    out.data({value_text(spring.stiffness)});
  }
  for (const Deck::Equation& equation : deck.equations) {
    out.keyword({"EQUATION"});
    out.data({std::to_string(equation.places.size())});
    std::vector<std::string> fields;
    for (std::size_t k = 0; k < equation.places.size(); ++k) {
      fields.push_back(std::to_string(deck.numbers[equation.places[k].node]));
      fields.push_back(std::to_string(equation.places[k].component));
      fields.push_back(value_text(equation.coefficients[k]));
    }
    out.data(fields, 12);
  }
  for (const Deck::Equation& pin : deck.pins) {
    out.keyword({"MPC"});
    out.data({cased(drawn, "PIN"), std::to_string(deck.numbers[pin.places[0].node]),
              std::to_string(deck.numbers[pin.places[1].node])});
  }
}

/// Writes the supports by sets or by nodes.
void add_supports(Case& drawn, const Deck& deck, InpText& out) {
  std::map<std::string, std::vector<std::size_t>> held;
  for (const Deck::Hold& hold : deck.holds) held[hold.components].push_back(hold.node);
  for (auto& [components, all] : held) {
    std::sort(all.begin(), all.end());
    const std::string set = "held" + components;
    const bool is_set = drawn.chance(0.5);
    if (is_set) add_inp_set(drawn, deck, set, all, out);
    out.keyword(drawn.chance(0.3) ? std::vector<std::string>{"BOUNDARY", "OP=MOD"}
                                  : std::vector<std::string>{"BOUNDARY"});
    const std::vector<std::string> who =
        is_set ? std::vector<std::string>{set} : numbers_of(deck, all);
    for (const std::string& name : who) {
      if (components == "123" && drawn.chance(0.5)) {
        if (drawn.chance(0.5))
          out.data({name, cased(drawn, "PINNED")});
        else
          out.data({name, "1", "3", "0."});
        continue;
      }
      for (const char component : components)
        out.data(drawn.chance(0.5) ? std::vector<std::string>{name, {component}}
                                   : std::vector<std::string>{name, {component}, "", "0.0"});
    }
  }
}

}  // namespace

std::string write_inp(Case& drawn, const Deck& deck, const std::filesystem::path& file,
                      bool refused) {
  static const std::vector<std::string> kRefused = {
      "*NODE, SYSTEM=C\n999999, 1., 2., 3.",
      "*BOUNDARY, TYPE=VELOCITY\nbottom, 1, 3",
      "*BOUNDARY\nbottom, 1, 1, 0.5",
      "*NSET, NSET=far, ELSET=solid",
      "*ELSET, ELSET=more, INSTANCE=one\n1",
      "*TIE, NAME=glue\none, two",
      "*COUPLING, REF NODE=1, SURFACE=s\n*KINEMATIC",
      "*EQUATION, INPUT=equations.txt",
      "*CLOUD\n1, 2",
      "*MPC\nSLIDER, 1, 2",
      "*TRANSFORM, NSET=top, TYPE=S\n0., 0., 0., 0., 0., 1.",
      "*ORIENTATION, NAME=fibres\n1., 0., 0., 0., 1., 0.",
      "*MATRIX INPUT, NAME=k, INPUT=k.mtx",
      "*PART, NAME=one",
      "*STEP\n*FREQUENCY\n5\n*END STEP\n*STEP\n*BOUNDARY\nbottom, 1\n*FREQUENCY\n5\n*END STEP"};
  InpText out(drawn);
  out.keyword({"HEADING"});
  out.text += "a deck of the campaign, *BOUNDARY not among it\n";
  add_mesh(drawn, deck, file, out);
  add_inp_set(drawn, deck, "bottom", deck.bottom, out);
  add_inp_set(drawn, deck, "top", deck.top, out);
  add_material(drawn, deck, out);
  add_axes(drawn, deck, out);
  add_connections(drawn, deck, out);
  const bool is_in_step = drawn.chance(0.3);
  if (is_in_step) out.keyword({"STEP"});
  add_supports(drawn, deck, out);
  const std::string wrong = refused ? one_of(drawn, kRefused) : "";
  if (!is_in_step) out.text += wrong + (wrong.empty() ? "" : "\n");
  if (!is_in_step) out.keyword({"STEP"});
  out.keyword({"CLOAD"});
  out.data({std::to_string(deck.numbers[0]), "1", "3.5"});
  out.keyword({"FREQUENCY", "EIGENSOLVER=LANCZOS"});
  out.data({"8"});
  out.keyword({"NODE PRINT", "NSET=all"});
  out.data({"U"});
  out.keyword({"END STEP"});
  if (is_in_step) out.text += wrong + (wrong.empty() ? "" : "\n");
  save(file, out.text);
  return wrong;
}

}  // namespace flexneck::campaigns
