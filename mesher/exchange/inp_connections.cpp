// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/exchange/inp_connections.h"

#include <algorithm>
#include <utility>

#include <Eigen/Geometry>

#include "geometry/foundation/error.h"
#include "mesher/exchange/inp_sets.h"

namespace flexneck::mesher {
namespace {

/// Components that named supports fix.
const std::map<std::string, std::set<int>>& named_supports() {
  static const std::map<std::string, std::set<int>> kSupports = {{"ENCASTRE", {1, 2, 3, 4, 5, 6}},
                                                                 {"PINNED", {1, 2, 3}},
                                                                 {"XSYMM", {1, 5, 6}},
                                                                 {"YSYMM", {2, 4, 6}},
                                                                 {"ZSYMM", {3, 4, 5}},
                                                                 {"XASYMM", {2, 3, 4}},
                                                                 {"YASYMM", {1, 3, 5}},
                                                                 {"ZASYMM", {1, 2, 6}}};
  return kSupports;
}

std::string line_of(const InpPlace& place) { return " in line " + std::to_string(place.line); }

/// A field of some lines taken one after another; blank fields at the end of a line do not count.
struct Field {
  const InpData* line;
  std::size_t field;
};

std::vector<Field> fields_from(const InpCard& card, std::size_t& line, std::size_t count) {
  std::vector<Field> fields;
  for (; line < card.data.size() && fields.size() < count; ++line) {
    for (std::size_t f = 0; f < card.data[line].fields.size(); ++f) {
      fields.push_back({&card.data[line], f});
    }
  }
  if (fields.size() != count) {
    card.refuse("expected " + std::to_string(count) + " fields" +
                line_of(card.data[std::min(line, card.data.size()) - 1].place) + ", found " +
                std::to_string(fields.size()));
  }
  return fields;
}

Eigen::Vector3d vector_at(const InpData& line, std::size_t first) {
  return {inp_number(line, first), inp_number(line, first + 1), inp_number(line, first + 2)};
}

}  // namespace

const std::map<std::string, InpConnectionReader::Handler>& InpConnectionReader::handlers() {
  static const std::map<std::string, Handler> kHandlers = {
      {"BOUNDARY", &InpConnectionReader::boundary},
      {"EQUATION", &InpConnectionReader::equation},
      {"MPC", &InpConnectionReader::mpc},
      {"MASS", &InpConnectionReader::point_property},
      {"RIGID BODY", &InpConnectionReader::rigid_body},
      {"SPRING", &InpConnectionReader::point_property},
      {"TRANSFORM", &InpConnectionReader::transform}};
  return kHandlers;
}

void InpConnectionReader::read(const InpCard& card, const InpModel& model) {
  (this->*handlers().at(card.keyword))(card, model);
}

void InpConnectionReader::boundary(const InpCard& card, const InpModel& model) {
  if (card.has("OP") && upper_case(card.parameter("OP")) == "NEW" && !supports_.empty()) {
    card.refuse("OP=NEW removes the supports defined before; use a single *BOUNDARY for the modes");
  }
  constexpr std::int64_t kLast = 6;  // higher components are temperatures and the like
  for (const InpData& line : card.data) {
    std::set<int> components;
    const std::string second = line.fields.size() > 1 ? upper_case(line.fields[1]) : "";
    if (const auto named = named_supports().find(second); named != named_supports().end()) {
      components = named->second;
    } else {
      const std::int64_t first = inp_integer(line, 1);
      const bool has_last = line.fields.size() > 2 && !line.fields[2].empty();
      const std::int64_t last = has_last ? inp_integer(line, 2) : first;
      for (std::int64_t d = std::max<std::int64_t>(first, 1); d <= std::min(last, kLast); ++d) {
        components.insert(static_cast<int>(d));
      }
    }
    if (line.fields.size() > 3 && !line.fields[3].empty() && inp_number(line, 3) != 0) {
      throw InputError(line.place.text() + "*BOUNDARY: expected displacements of zero");
    }
    const std::vector<std::int64_t> nodes = inp_members_of(line, 0, model.nsets, "NSET");
    if (!is_inp_set(line, 0, model.nsets)) supported_by_number_.push_back(nodes.front());
    for (const std::int64_t node : nodes)
      supports_[node].insert(components.begin(), components.end());
  }
}

void InpConnectionReader::equation(const InpCard& card, const InpModel& /*model*/) {
  for (std::size_t line = 0; line < card.data.size();) {
    const InpPlace place = card.data[line].place;
    const std::int64_t count = inp_integer(card.data[line], 0);
    constexpr std::int64_t kMost = 1'000'000;
    if (count < 1 || count > kMost) throw InputError(place.text() + "expected a number of terms");
    DeckEquation equation{"*EQUATION" + line_of(place), {}};
    const auto fields = fields_from(card, ++line, 3 * static_cast<std::size_t>(count));
    for (std::size_t f = 0; f < fields.size(); f += 3) {
      equation.terms.push_back({inp_integer(*fields[f].line, fields[f].field),
                                inp_component(*fields[f + 1].line, fields[f + 1].field),
                                inp_number(*fields[f + 2].line, fields[f + 2].field)});
    }
    connections_.equations.push_back(std::move(equation));
  }
}

void InpConnectionReader::mpc(const InpCard& card, const InpModel& model) {
  for (const InpData& line : card.data) {
    const std::string type = line.fields.empty() ? "" : upper_case(line.fields[0]);
    const bool is_same = type == "PIN" || type == "TIE";
    if ((!is_same && type != "LINK" && type != "BEAM") || line.fields.size() != 3) {
      throw InputError(line.place.text() +
                       "*MPC: expected PIN, TIE, LINK or BEAM and two nodes, found '" + type +
                       "' with " + std::to_string(line.fields.size()) + " fields");
    }
    const std::int64_t one = inp_integer(line, 1);
    const std::int64_t two = inp_integer(line, 2);
    for (const std::int64_t node : {one, two}) {
      if (model.nodes.count(node) > 0) continue;
      throw InputError(line.place.text() + "*MPC has node " + std::to_string(node) +
                       ", which *NODE does not define");
    }
    const std::string name = "*MPC" + line_of(line.place);
    if (is_same) {
      for (int a = 1; a <= 3; ++a) {
        connections_.equations.push_back({name, {{one, a, 1}, {two, a, -1}}});
      }
      continue;
    }
    // The distance between the two nodes stays constant.
    const Eigen::Vector3d along =
        Eigen::Vector3d(model.nodes.at(one).data()) - Eigen::Vector3d(model.nodes.at(two).data());
    if (!(along.norm() > 0)) {
      throw InputError(line.place.text() + "*MPC: the two nodes coincide");
    }
    Eigen::Index largest = 0;
    along.cwiseAbs().maxCoeff(&largest);
    DeckEquation equation{name, {}};
    for (Eigen::Index k = 0; k < 3; ++k) {  // the largest component comes first
      const Eigen::Index a = (largest + k) % 3;
      if (along[a] == 0) continue;
      equation.terms.push_back({one, static_cast<int>(a) + 1, along[a] / along.norm()});
    }
    for (Eigen::Index a = 0; a < 3; ++a) {
      if (along[a] == 0) continue;
      equation.terms.push_back({two, static_cast<int>(a) + 1, -along[a] / along.norm()});
    }
    connections_.equations.push_back(std::move(equation));
  }
}

void InpConnectionReader::rigid_body(const InpCard& card, const InpModel& model) {
  DeckCoupling coupling;
  coupling.name = "*RIGID BODY" + line_of(card.place);
  const InpData names{card.place,
                      {card.has("NSET") ? card.parameter("NSET") : "",
                       card.has("ELSET") ? card.parameter("ELSET") : "", card.parameter("REF NODE"),
                       card.has("ROT NODE") ? card.parameter("ROT NODE") : "0"},
                      false};
  if (card.has("NSET") == card.has("ELSET"))
    card.refuse("expected exactly one of NSET= and ELSET=");
  coupling.reference = inp_integer(names, 2);
  coupling.rotation = inp_integer(names, 3);
  if (card.has("NSET")) {
    coupling.nodes = inp_members_of(names, 0, model.nsets, "NSET");
  } else {
    const std::vector<std::int64_t> members = inp_members_of(names, 1, model.elsets, "ELSET");
    const std::set<std::int64_t> elements(members.begin(), members.end());
    std::set<std::int64_t> nodes;
    for (const InpElement& element : model.elements) {
      if (elements.count(element.number) == 0) continue;
      nodes.insert(element.nodes.begin(), element.nodes.end());
    }
    coupling.nodes.assign(nodes.begin(), nodes.end());
  }
  connections_.couplings.push_back(std::move(coupling));
}

void InpConnectionReader::transform(const InpCard& card, const InpModel& model) {
  const std::string type = card.has("TYPE") ? upper_case(card.parameter("TYPE")) : "R";
  if (card.data.size() != 1) card.refuse("expected one line of data");
  const Eigen::Vector3d one = vector_at(card.data.front(), 0);
  const Eigen::Vector3d other = vector_at(card.data.front(), 3);
  AxisSystem axes;
  try {
    axes.is_cylindrical = type == "C";
    axes.origin_m = axes.is_cylindrical ? one : Eigen::Vector3d::Zero();
    axes.axes = axes.is_cylindrical ? axes_from(other - one, Eigen::Vector3d::Zero())
                                    : axes_from(one.cross(other), one);
  } catch (const InputError& error) {
    card.refuse(error.what());
  }
  const InpData name{card.place, {card.parameter("NSET")}, false};
  for (const std::int64_t node : inp_members_of(name, 0, model.nsets, "NSET")) {
    connections_.axes[node] = axes;
  }
}

DeckConnections InpConnectionReader::finish(const InpModel& model) {
  for (const DeckEquation& equation : connections_.equations) {
    for (const DeckTerm& term : equation.terms) {
      if (!equation.name.starts_with("*MPC") || connections_.axes.count(term.node) == 0) continue;
      throw InputError(equation.name + " is at a node with a *TRANSFORM, which is not supported");
    }
  }
  point_elements_.add_to(connections_);
  for (const auto& [node, components] : supports_) {
    if (model.nodes.count(node) == 0) continue;  // a number within a range may be missing
    DeckSupport support{"*BOUNDARY", node, {}};
    for (const int component : components) {
      support.components[static_cast<std::size_t>(component - 1)] = true;
    }
    connections_.supports.push_back(support);
  }
  return std::move(connections_);
}

}  // namespace flexneck::mesher
