// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <map>

#include "tests/campaigns/deck.h"
#include "tests/campaigns/deck_fields.h"

namespace flexneck::campaigns {
namespace {

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

/// Writes axes and nodes, some with permanent supports. @return the other supports
std::vector<Deck::Hold> add_nodes(Case& drawn, const Deck& deck, BdfText& out) {
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
    std::vector<std::string> fields = {std::to_string(deck.numbers[node]),
                                       drawn.chance(0.2) ? "0" : ""};
    for (const double c : x) fields.push_back(coordinate(drawn, c, true));
    fields.push_back(system_of.count(node) > 0 ? std::to_string(system_of[node]) : "");
    fields.push_back(permanent.count(node) > 0 ? permanent[node] : "");
    out.card("GRID", fields);
  }
  return holds;
}

/// Writes masses, couplings and springs. @param weight  WTMASS, by which the reader multiplies
/// masses
void add_connections(Case& drawn, const Deck& deck, double weight, BdfText& out) {
  const auto number = [&](std::size_t node) { return std::to_string(deck.numbers[node]); };
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
}

/// Writes equations, and pins as three each.
void add_equations(const Deck& deck, BdfText& out) {
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
      fields.push_back(std::to_string(deck.numbers[equation.places[k].node]));
      fields.push_back(std::to_string(equation.places[k].component));
      fields.push_back(real(equation.coefficients[k]));
    }
    out.card("MPC", fields);
  }
}

}  // namespace

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
  const std::vector<Deck::Hold> holds = add_nodes(drawn, deck, out);
  for (const std::size_t e : shuffled(drawn, deck.elements.size())) {
    std::vector<std::string> fields = element_fields(deck, e, orders.nastran);
    fields.insert(fields.begin(), {std::to_string(deck.element_numbers[e]), "1"});
    out.card(orders.nastran_type, fields);
  }
  out.card("PSOLID", {"1", "1"});
  out.card("MAT1", {"1", "2.1+5", "", ".3", "7.8-9"});
  const double weight = drawn.chance(0.2) ? 0.1 : 1;
  if (weight != 1) out.card("PARAM", {"WTMASS", "0.1"});
  add_connections(drawn, deck, weight, out);
  add_equations(deck, out);
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
           cased(drawn, deck.equations.empty() && deck.pins.empty() ? "METHOD = 1" : "MPC 21") +
           "\n" + cased(drawn, "BEGIN BULK") + "\n";
    out.card("SPC1", {"77", "123", number(1), number(2)});  // belongs to a set that is not selected
  }
  std::string wrong = refused ? one_of(drawn, kRefused) : "";
  for (std::size_t at = wrong.find('@'); at != std::string::npos; at = wrong.find('@'))
    wrong.replace(at, 2, number(static_cast<std::size_t>(wrong[at + 1] - '0')));
  save(file, head + out.text + wrong + "\n" + out.later +
                 (drawn.chance(0.5) ? "ENDDATA\nnothing counts behind it\n" : ""));
  return wrong;
}

}  // namespace flexneck::campaigns
