// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/campaigns/deck.h"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <functional>
#include <map>
#include <sstream>

#include "mesher/mesh/element_kind.h"

namespace flexneck::campaigns {
namespace {

using mesher::ElementKind;

std::string printed(const char* format, double value) {
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), format, value);
  return text.data();
}

/// Text of a coordinate with at most three decimals.
std::string coordinate(Case& drawn, double value, bool is_short) {
  const int style = is_short ? 0 : drawn.whole(0, 2);
  std::string text = printed(style == 0 ? "%.3f" : "%.6E", value);
  if (style == 2) text[text.find('E')] = 'D';
  return text;
}

/// A value of four digits: 1.234E+03.
std::string value_text(double value) { return printed("%.3E", value); }

/// The text in capitals, in small letters, or unchanged.
std::string cased(Case& drawn, std::string text) {
  const int style = drawn.whole(0, 2);
  for (char& c : text) {
    if (style == 0) c = static_cast<char>(std::toupper(c));
    if (style == 1) c = static_cast<char>(std::tolower(c));
  }
  return text;
}

/// Node order of a format, given by corners, and midside nodes by their two corners.
std::vector<std::size_t> order_of(ElementKind kind, const std::string& text) {
  const auto nodes = mesher::reference_nodes(kind);
  std::istringstream words(text);
  std::vector<std::size_t> order;
  for (std::string word; words >> word && order.size() < nodes.size();) {
    const auto first = static_cast<std::size_t>(word.front() - '0');
    const auto last = static_cast<std::size_t>(word.back() - '0');
    std::array<double, 3> middle{};
    for (std::size_t d = 0; d < 3; ++d) middle[d] = (nodes[first][d] + nodes[last][d]) / 2;
    const auto found = std::find(nodes.begin(), nodes.end(), middle);
    if (found != nodes.end()) order.push_back(static_cast<std::size_t>(found - nodes.begin()));
  }
  return order;
}

struct Orders {
  const char *abaqus_type, *abaqus, *nastran_type, *nastran, *unv_type, *unv, *gmsh_type, *gmsh;
};

/// Node orders of the formats by shape; linear kinds have the same corners.
const Orders& orders_of(ElementKind kind) {
  static const Orders kHexahedron = {
      "C3D20", "0 1 2 3 4 5 6 7 01 12 23 30 45 56 67 74 04 15 26 37",
      "CHEXA", "0 1 2 3 4 5 6 7 01 12 23 30 04 15 26 37 45 56 67 74",
      "116",   "0 01 1 12 2 23 3 30 04 15 26 37 4 45 5 56 6 67 7 74",
      "17",    "0 1 2 3 4 5 6 7 01 03 04 12 15 23 26 37 45 47 56 67"};
  static const Orders kPrism = {"C3D15",  "0 1 2 3 4 5 01 12 20 34 45 53 03 14 25",
                                "CPENTA", "0 1 2 3 4 5 01 12 20 03 14 25 34 45 53",
                                "113",    "0 01 1 12 2 20 03 14 25 3 34 4 45 5 53",
                                "18",     "0 1 2 3 4 5 01 02 03 12 14 25 34 35 45"};
  static const Orders kTetrahedron = {
      "C3D10", "0 1 2 3 01 12 20 03 13 23", "CTETRA", "0 1 2 3 01 12 20 03 13 23",
      "118",   "0 01 1 12 2 20 03 13 23 3", "11",     "0 1 2 3 01 12 02 03 23 13"};
  static const Orders kHex8 = {"C3D8", "0 1 2 3 4 5 6 7", "CHEXA", "0 1 2 3 4 5 6 7",
                               "115",  "0 1 2 3 4 5 6 7", "5",     "0 1 2 3 4 5 6 7"};
  static const Orders kPrism6 = {"C3D6", "0 1 2 3 4 5", "CPENTA", "0 1 2 3 4 5",
                                 "112",  "0 1 2 3 4 5", "6",      "0 1 2 3 4 5"};
  if (kind == ElementKind::hex8) return kHex8;
  if (kind == ElementKind::prism6) return kPrism6;
  if (kind == ElementKind::prism15) return kPrism;
  return kind == ElementKind::tet10 ? kTetrahedron : kHexahedron;
}

std::vector<std::string> numbers_of(const Deck& deck, const std::vector<std::size_t>& nodes) {
  std::vector<std::string> texts;
  for (const std::size_t node : nodes) texts.push_back(std::to_string(deck.numbers[node]));
  return texts;
}

std::vector<std::string> element_fields(const Deck& deck, std::size_t element,
                                        const std::string& order) {
  std::vector<std::size_t> nodes;
  for (const std::size_t k : order_of(deck.kind, order)) nodes.push_back(deck.elements[element][k]);
  return numbers_of(deck, nodes);
}

/// Random order in which a deck writes its items.
std::vector<std::size_t> shuffled(Case& drawn, std::size_t count) {
  std::vector<std::size_t> all(count);
  for (std::size_t k = 0; k < count; ++k) all[k] = k;
  std::shuffle(all.begin(), all.end(), drawn.random);
  return all;
}

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

/// Writes bulk data: cards in free fields, in fixed ones of 8 or of 16 columns, continued in each
/// style.
class BdfText {
 public:
  explicit BdfText(Case& drawn) : drawn_(drawn) {}

  void card(const std::string& name, std::vector<std::string> fields) {
    while (!fields.empty() && fields.back().empty()) fields.pop_back();
    const int style = drawn_.whole(0, 2);
    const std::size_t per_line = style == 2 ? 4 : 8;
    const bool is_marked = drawn_.chance(0.5);
    const bool is_apart = is_marked && drawn_.chance(0.3);
    if (drawn_.chance(0.1)) text += "$ SPC,1,123,1\n";
    std::string head = name + (style == 2 ? "*" : "");
    for (std::size_t first = 0; first == 0 || first < fields.size(); first += per_line) {
      const bool has_more = first + per_line < fields.size();
      const std::string mark = is_marked && has_more ? "+M" + std::to_string(++marks_) : "";
      std::string line = style == 0 ? head : padded(head, 8);
      for (std::size_t k = first; k < first + per_line; ++k) {
        const std::string field = k < fields.size() ? fields[k] : "";
        if (style == 0 && k >= fields.size() && mark.empty()) break;
        line += style == 0 ? "," + field : padded(field, style == 2 ? 16 : 8);
      }
      if (!mark.empty()) line += (style == 0 ? "," : "") + mark;
      while (style > 0 && line.back() == ' ') line.pop_back();
      if (drawn_.chance(0.1)) line += "$ a comment";
      (is_apart && first > 0 ? later : text) += cased(drawn_, line) + "\n";
      head = mark.empty() ? (style == 2 ? "*" : style == 1 || drawn_.chance(0.5) ? "" : "+") : mark;
      if (style == 2 && !mark.empty()) head[0] = '*';
    }
  }

  std::string text, later;

 private:
  static std::string padded(std::string field, std::size_t width) {
    field.resize(std::max(width, field.size()), ' ');
    return field;
  }
  Case& drawn_;
  int marks_ = 0;
};

/// Nastran's real of at most eight characters: 1.234+3.
std::string real(double value) {
  std::string text = value_text(value);
  const std::size_t e = text.find('E');
  return text.substr(0, e) + text[e + 1] + std::to_string(std::stoi(text.substr(e + 2)));
}

void save(const std::filesystem::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

template <class Choices>
const auto& one_of(Case& drawn, const Choices& choices) {
  return choices[static_cast<std::size_t>(drawn.whole(0, static_cast<int>(choices.size()) - 1))];
}

}  // namespace

Eigen::Matrix3d DeckAxes::frame() const {
  Eigen::Matrix3d axes;
  axes.col(2) = (on_z - origin).normalized();
  axes.col(1) = axes.col(2).cross(in_xz - origin).normalized();
  axes.col(0) = axes.col(1).cross(axes.col(2));
  return axes;
}

Eigen::Matrix3d DeckAxes::at(const Eigen::Vector3d& position) const {
  if (!is_cylindrical) return frame();
  return DeckAxes{false, origin, on_z, position, {}}.frame();
}

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
  const Orders& orders = orders_of(deck.kind);
  InpText out(drawn);
  out.keyword({"HEADING"});
  out.text += "a deck of the campaign, *BOUNDARY not among it\n";
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
  add_inp_set(drawn, deck, "bottom", deck.bottom, out);
  add_inp_set(drawn, deck, "top", deck.top, out);
  out.keyword({"MATERIAL", "NAME=stuff"});
  out.keyword(drawn.chance(0.5) ? std::vector<std::string>{"ELASTIC"}
                                : std::vector<std::string>{"ELASTIC", "TYPE=ISO"});
  out.data({value_text(deck.youngs_modulus), value_text(deck.poissons_ratio)});
  out.keyword({"DENSITY"});
  out.data({value_text(deck.density)});
  out.keyword({"SOLID SECTION", "MATERIAL=stuff", "ELSET=solid"});
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
  const bool is_in_step = drawn.chance(0.3);
  if (is_in_step) out.keyword({"STEP"});
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

std::string write_bdf(Case& drawn, const Deck& deck, const std::filesystem::path& file,
                      bool refused) {
  static const std::vector<std::string> kRefused = {
      "RBAR,900001,@0,@1,123456",
      "RBE3,900001,,@0,123,1.,123,@1,@2",
      "CBUSH,900001,1,@0,@1",
      "CELAS3,900001,1,1,2",
      "CMASS2,900001,1.,@0,1",
      "NSM1,900001,PSOLID,,1.,1",
      "DMIG,K2,0,6,1,0",
      "INCLUDE 'more.bdf'",
      "PARAM,CK1,2.",
      "GRID,900001,7,1.,2.,3.",
      "GRDSET,,7",
      "SPC,11,@0,1,0.5",
      "SPC1,11,1,@0,@1,@2,@3,@4,@5,@6,@7",
      "GRID\t900001\t\t1.\t2.\t3.",
      "CQUAD4,900001,900,@0,@1,@2,@3\nPSHELL,900,1,.1",
      "+LOST,1,2"};
  const Orders& orders = orders_of(deck.kind);
  const auto number = [&](std::size_t node) { return std::to_string(deck.numbers[node]); };
  BdfText out(drawn);
  std::map<std::size_t, int> system_of;
  int systems = 30;
  for (const DeckAxes& axes : deck.axes) {
    ++systems;
    for (const std::size_t node : axes.nodes) system_of[node] = systems;
    std::vector<std::string> fields = {std::to_string(systems), drawn.chance(0.5) ? "0" : ""};
    for (const Eigen::Vector3d& v : {axes.origin, axes.on_z, axes.in_xz})
      for (const double x : v) fields.push_back(coordinate(drawn, x, true));
    out.card(axes.is_cylindrical ? "CORD2C" : "CORD2R", fields);
  }
  std::map<std::size_t, std::string> permanent;
  std::vector<Deck::Hold> holds;
  for (const Deck::Hold& hold : deck.holds) {
    if (drawn.chance(0.2) && permanent.count(hold.node) == 0)
      permanent[hold.node] = hold.components;
    else
      holds.push_back(hold);
  }
  for (const std::size_t node : shuffled(drawn, deck.places.size())) {
    const Eigen::Vector3d& x = deck.places[node];
    std::vector<std::string> fields = {number(node), drawn.chance(0.2) ? "0" : ""};
    for (const double c : x) fields.push_back(coordinate(drawn, c, true));
    fields.push_back(system_of.count(node) > 0 ? std::to_string(system_of[node]) : "");
    fields.push_back(permanent.count(node) > 0 ? permanent[node] : "");
    out.card("GRID", fields);
  }
  for (const std::size_t e : shuffled(drawn, deck.elements.size())) {
    std::vector<std::string> fields = element_fields(deck, e, orders.nastran);
    fields.insert(fields.begin(), {std::to_string(deck.element_numbers[e]), "1"});
    out.card(orders.nastran_type, fields);
  }
  out.card("PSOLID", {"1", "1"});
  out.card("MAT1", {"1", "2.1+5", "", ".3", "7.8-9"});
  const double weight = drawn.chance(0.2) ? 0.1 : 1;
  if (weight != 1) out.card("PARAM", {"WTMASS", "0.1"});
  int elements = 800000;
  for (const Deck::Mass& mass : deck.masses) {
    const auto& i = mass.inertia;
    std::vector<std::string> fields = {std::to_string(++elements), number(mass.node), "",
                                       real(mass.mass / weight)};
    for (const double x : mass.center) fields.push_back(real(x));
    fields.push_back("");
    for (const double product : {i[0], -i[3], i[1], -i[4], -i[5], i[2]})
      fields.push_back(real(product / weight));
    if (mass.center.isZero(0) && i[0] == 0) fields.resize(4);
    out.card("CONM2", fields);
  }
  for (const Deck::Coupling& coupling : deck.couplings) {
    std::vector<std::string> fields = numbers_of(deck, coupling.nodes);
    fields.insert(fields.begin(),
                  {std::to_string(++elements), number(coupling.point), coupling.components});
    if (drawn.chance(0.2)) fields.push_back("1.2-5");  // thermal expansion
    out.card("RBE2", fields);
  }
  for (const Deck::Spring& spring : deck.springs) {
    const bool by_property = drawn.chance(0.5);
    std::vector<std::string> fields = {
        std::to_string(++elements), by_property ? std::to_string(elements) : real(spring.stiffness),
        number(spring.one.node), std::to_string(spring.one.component)};
    if (spring.has_other) {
      fields.push_back(number(spring.other.node));
      fields.push_back(std::to_string(spring.other.component));
    }
    if (by_property) out.card("PELAS", {std::to_string(elements), real(spring.stiffness)});
    out.card(by_property ? "CELAS1" : "CELAS2", fields);
  }
  std::vector<Deck::Equation> equations = deck.equations;
  for (const Deck::Equation& pin : deck.pins) {
    for (int component = 1; component <= 3; ++component) {
      equations.push_back(pin);
      for (DeckPlace& place : equations.back().places) place.component = component;
    }
  }
  for (const Deck::Equation& equation : equations) {
    std::vector<std::string> fields = {"21"};
    for (std::size_t k = 0; k < equation.places.size(); ++k) {
      if (k > 0 && k % 2 == 0) fields.insert(fields.end(), {"", ""});
      fields.push_back(number(equation.places[k].node));
      fields.push_back(std::to_string(equation.places[k].component));
      fields.push_back(real(equation.coefficients[k]));
    }
    out.card("MPC", fields);
  }
  const bool is_union = drawn.chance(0.3);
  for (const Deck::Hold& hold : holds) {
    const std::string set = is_union && drawn.chance(0.5) ? "12" : "11";
    if (drawn.chance(0.5))
      out.card("SPC", {set, number(hold.node), hold.components, "0."});
    else
      out.card("SPC1", {set, hold.components, number(hold.node)});
  }
  out.card("FORCE", {"5", number(0), "0", "1.", "0.", "0.", "1."});
  out.card("EIGRL", {"1", "", "", "8"});
  std::string head;
  if (is_union) out.card("SPCADD", {"10", "11", "12"});
  if (drawn.chance(0.7)) {
    head = "SOL 103\nCEND\n" + cased(drawn, std::string("SPC = ") + (is_union ? "10" : "11")) +
           " $ the supports\n" + (drawn.chance(0.5) ? "SUBCASE 1\n" : "") +
           cased(drawn, equations.empty() ? "METHOD = 1" : "MPC 21") + "\n" +
           cased(drawn, "BEGIN BULK") + "\n";
    out.card("SPC1", {"77", "123", number(1), number(2)});  // belongs to a set that is not selected
  }
  std::string wrong = refused ? one_of(drawn, kRefused) : "";
  for (std::size_t at = wrong.find('@'); at != std::string::npos; at = wrong.find('@'))
    wrong.replace(at, 2, number(static_cast<std::size_t>(wrong[at + 1] - '0')));
  save(file, head + out.text + wrong + "\n" + out.later +
                 (drawn.chance(0.5) ? "ENDDATA\nnothing counts behind it\n" : ""));
  return wrong;
}

std::string write_unv(Case& drawn, const Deck& deck, const std::filesystem::path& file,
                      bool refused) {
  const Orders& orders = orders_of(deck.kind);
  const auto join = [](const std::vector<std::string>& words) {
    std::string line;
    for (const std::string& word : words) line += "  " + word;
    return line + "\n";
  };
  std::string text = "    -1\n  2411\n";
  for (const std::size_t node : shuffled(drawn, deck.places.size())) {
    const Eigen::Vector3d& x = deck.places[node];
    text += "  " + std::to_string(deck.numbers[node]) + "  1  1  11\n" +
            join({coordinate(drawn, x[0], false), coordinate(drawn, x[1], false),
                  coordinate(drawn, x[2], false)});
  }
  text += "    -1\n    -1\n  2412\n";
  for (const std::size_t e : shuffled(drawn, deck.elements.size())) {
    const std::vector<std::string> nodes = element_fields(deck, e, orders.unv);
    text += join({std::to_string(deck.element_numbers[e]), orders.unv_type, "1", "1", "7",
                  std::to_string(nodes.size())});
    for (std::size_t k = 0; k < nodes.size(); k += 8)
      text += join({nodes.begin() + static_cast<std::ptrdiff_t>(k),
                    nodes.begin() + static_cast<std::ptrdiff_t>(std::min(k + 8, nodes.size()))});
  }
  static const std::vector<std::string> kGroups = {"2435", "2452", "2467", "2477"};
  text += "    -1\n    -1\n  " + one_of(drawn, kGroups) + "\n";
  for (const auto& [name, nodes] : {std::pair("bottom", deck.bottom), std::pair("top", deck.top)}) {
    text += "  1  0  0  0  0  0  0  " + std::to_string(nodes.size()) + "\n" + name + "\n";
    for (std::size_t k = 0; k < nodes.size(); ++k)
      text += "  7  " + std::to_string(deck.numbers[nodes[k]]) + "  0  0" +
              (k % 2 == 1 || k + 1 == nodes.size() ? "\n" : "");
  }
  text += "    -1\n";
  static const std::vector<std::string> kRefused = {
      "    -1\n  2412\n  900001  117  1  1  7  2\n  1  2\n    -1\n",
      "    -1\n  2467\n  1  0  0  0  0  0  0  1\nlost\n  7  999999  0  0\n    -1\n",
      "    -1\n  2411\n  900001  1  1  11\n  1.0  2.0\n    -1\n", "    -1\n  2411\n"};
  const std::string wrong = refused ? one_of(drawn, kRefused) : "";
  save(file, text + wrong);
  return wrong;
}

std::string write_msh(Case& drawn, const Deck& deck, const std::filesystem::path& file,
                      bool refused) {
  const Orders& orders = orders_of(deck.kind);
  std::ostringstream out;
  out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n3\n0 1 \"bottom\"\n0 2 \"top\"\n"
         "3 3 \"solid\"\n$EndPhysicalNames\n$Nodes\n"
      << deck.places.size() << "\n";
  for (const std::size_t node : shuffled(drawn, deck.places.size())) {
    out << deck.numbers[node];
    for (const double x : deck.places[node]) out << " " << printed("%.6E", x);
    out << "\n";
  }
  out << "$EndNodes\n$Elements\n"
      << deck.elements.size() + deck.bottom.size() + deck.top.size() << "\n";
  int next = 0;
  int group = 0;
  for (const auto* const nodes : {&deck.bottom, &deck.top}) {
    ++group;
    for (const std::size_t node : *nodes) {
      ++next;
      out << next << " 15 2 " << group << " " << next << " " << deck.numbers[node] << "\n";
    }
  }
  for (const std::size_t e : shuffled(drawn, deck.elements.size())) {
    out << ++next << " " << orders.gmsh_type << " 2 3 1";
    for (const std::string& node : element_fields(deck, e, orders.gmsh)) out << " " << node;
    out << "\n";
  }
  out << "$EndElements\n";
  static const std::vector<std::string> kRefused = {
      "Merge \"other.msh\";\n", "$ParametricNodes\n0\n$EndParametricNodes\n",
      "$Elements\n1\n1 15 2 9 1 999999\n$EndElements\n"};
  const std::string wrong = refused ? one_of(drawn, kRefused) : "";
  save(file, out.str() + wrong);
  return wrong;
}

}  // namespace flexneck::campaigns
