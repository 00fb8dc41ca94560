// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/exchange/nastran_connections.h"

#include <algorithm>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include <Eigen/Geometry>

#include "geometry/foundation/error.h"
#include "mesher/exchange/inp_cards.h"
#include "mesher/exchange/nastran_fields.h"

namespace flexneck::mesher {
namespace {

class ConnectionReader {
 public:
  ConnectionReader(const std::map<std::int64_t, std::array<double, 3>>& positions,
                   LeftOut& left_out)
      : positions_(positions), left_out_(left_out) {}

  void read(const NastranCard& card) {
    if (card.name == "GRID") {
      grids_.push_back(card);
    } else if (card.name == "GRDSET") {
      grid_set_ = card;
    } else if (card.name.starts_with("CORD")) {
      systems_[nastran_integer(card, 0)] = card;
    } else if (card.name == "PELAS") {
      for (std::size_t first = 0; first + 1 < card.fields.size(); first += 4) {
        if (!card.field(first).empty())
          stiffness_[nastran_integer(card, first)] = nastran_number(card, first + 1);
      }
    } else if (card.name == "PARAM" && upper_case(card.field(0)) == "WTMASS") {
      mass_factor_ = nastran_number(card, 1, 1);
    } else if (card.name == "SPCADD" || card.name == "MPCADD") {
      const std::vector<std::int64_t> sets = nastran_list(card, 1);
      unions_[card.name.substr(0, 3)][nastran_integer(card, 0)] = {sets.begin(), sets.end()};
    } else if (is_nastran_connection(card.name)) {
      cards_.push_back(card);
    }
  }

  DeckConnections finish(const NastranCaseControl& control) {
    for (const NastranCard& grid : grids_) add_grid(grid);
    const std::set<std::int64_t> spc = selected("SPC", control);
    const std::set<std::int64_t> mpc = selected("MPC", control);
    for (const NastranCard& card : cards_) {
      const std::string kind = card.name.substr(0, 3);
      if (kind == "SPC" || kind == "MPC") {
        if ((kind == "SPC" ? spc : mpc).count(nastran_integer(card, 0)) == 0) {
          left_out_.add(card.name + " of sets that are not selected");
          continue;
        }
      }
      add(card);
    }
    add_axes();
    return std::move(deck_);
  }

 private:
  /// Numbers of the selected sets; SPCADD and MPCADD are replaced by their parts.
  std::set<std::int64_t> selected(const std::string& kind, const NastranCaseControl& control) {
    std::set<std::int64_t> there;
    for (const NastranCard& card : cards_) {
      if (card.name.starts_with(kind)) there.insert(nastran_integer(card, 0));
    }
    std::set<std::int64_t> chosen;
    if (control.is_given) {
      const auto found = control.sets.find(kind);
      if (found != control.sets.end()) chosen = {found->second};
    } else if (unions_[kind].size() == 1) {
      chosen = {unions_[kind].begin()->first};
    } else {
      chosen = there;
    }
    if (chosen.size() > 1) {
      throw InputError("the deck has several sets of " + kind +
                       " and no case control; select one, for example with " + kind + " = " +
                       std::to_string(*chosen.begin()) + " before BEGIN BULK");
    }
    if (chosen.empty()) return chosen;
    const auto parts = unions_[kind].find(*chosen.begin());
    return parts == unions_[kind].end() ? chosen : parts->second;
  }

  std::string grid_field(const NastranCard& card, std::size_t field) const {
    const std::string& own = card.field(field);
    return own.empty() && grid_set_ ? grid_set_->field(field) : own;
  }

  void add_grid(const NastranCard& card) {
    const std::int64_t number = nastran_integer(card, 0);
    NastranCard with_defaults = card;
    with_defaults.fields.resize(std::max<std::size_t>(card.fields.size(), 8));
    for (const std::size_t field : {5U, 6U}) with_defaults.fields[field] = grid_field(card, field);
    const std::int64_t system = nastran_integer_or(with_defaults, 5, 0);
    const std::array<bool, 6> fixed = nastran_components(with_defaults, 6);
    if (fixed != std::array<bool, 6>{}) deck_.supports.push_back({"GRID", number, fixed});
    if (system != 0) systems_of_grids_[number] = {card, system};
  }

  /// Adds the axes of nodes that are supported or connected; axes of others have no effect.
  void add_axes() {
    std::set<std::int64_t> used;
    for (const DeckSupport& support : deck_.supports) used.insert(support.node);
    for (const DeckCoupling& coupling : deck_.couplings) {
      used.insert(coupling.reference);
      used.insert(coupling.nodes.begin(), coupling.nodes.end());
    }
    for (const DeckEquation& equation : deck_.equations) {
      for (const DeckTerm& term : equation.terms) used.insert(term.node);
    }
    for (const DeckSpring& spring : deck_.springs) {
      for (const DeckTerm& term : spring.terms) used.insert(term.node);
    }
    for (const auto& [number, grid] : systems_of_grids_) {
      if (used.count(number) > 0) deck_.axes[number] = axes_of(grid.first, grid.second);
    }
  }

  Eigen::Vector3d grid_position(const NastranCard& card, std::size_t field) const {
    const auto found = positions_.find(nastran_integer(card, field));
    if (found == positions_.end()) refuse_card(card, "there is no GRID " + card.field(field));
    return Eigen::Vector3d(found->second.data());
  }

  AxisSystem axes_of(const NastranCard& user, std::int64_t number) const {
    const auto found = systems_.find(number);
    if (found == systems_.end()) {
      refuse_card(user, "there is no coordinate system " + std::to_string(number));
    }
    const NastranCard& card = found->second;
    const bool by_grids = card.name == "CORD1R" || card.name == "CORD1C";
    if (!by_grids && card.name != "CORD2R" && card.name != "CORD2C") {
      refuse_card(card,
                  "supports and couplings in this type of coordinate system are not supported");
    }
    std::array<Eigen::Vector3d, 3> points;
    if (by_grids) {
      for (std::size_t k = 0; k < 3; ++k) points[k] = grid_position(card, k + 1);
    } else {
      if (nastran_integer_or(card, 1, 0) != 0) {
        refuse_card(card,
                    "a coordinate system defined in another one is not supported; define it in the "
                    "basic system");
      }
      for (std::size_t k = 0; k < 3; ++k) {
        points[k] = {nastran_number(card, 3 * k + 2), nastran_number(card, 3 * k + 3),
                     nastran_number(card, 3 * k + 4)};
      }
    }
    AxisSystem axes;
    axes.origin_m = points[0];  // in the deck's unit
    axes.is_cylindrical = card.name.back() == 'C';
    try {
      axes.axes = axes_from(points[1] - points[0], points[2] - points[0]);
    } catch (const InputError& error) {
      refuse_card(card, error.what());
    }
    return axes;
  }

  void add(const NastranCard& card) {
    if (card.name == "SPC") return add_spc(card);
    if (card.name == "SPC1") return add_spc1(card);
    if (card.name == "MPC") return add_mpc(card);
    if (card.name == "RBE2") return add_rbe2(card);
    if (card.name == "CONM2") return add_conm2(card);
    add_spring(card);
  }

  void add_spc(const NastranCard& card) {
    for (std::size_t first = 1; first < 7 && !card.field(first).empty(); first += 3) {
      if (nastran_number(card, first + 2) != 0) refuse_card(card, "expected displacements of zero");
      deck_.supports.push_back({"SPC " + card.field(0), nastran_integer(card, first),
                                nastran_components(card, first + 1)});
    }
  }

  void add_spc1(const NastranCard& card) {
    const auto is_there = [&](std::int64_t node) { return positions_.count(node) > 0; };
    for (const std::int64_t node : nastran_list(card, 2, is_there)) {
      deck_.supports.push_back({"SPC1 " + card.field(0), node, nastran_components(card, 1)});
    }
  }

  void add_mpc(const NastranCard& card) {
    DeckEquation equation{"MPC " + card.field(0) + " in line " + std::to_string(card.line), {}};
    for (std::size_t line = 0; line < card.fields.size(); line += 8) {
      for (const std::size_t first : {line + 1, line + 4}) {
        if (card.field(first).empty()) continue;
        equation.terms.push_back({nastran_integer(card, first), nastran_component(card, first + 1),
                                  nastran_number(card, first + 2)});
      }
    }
    if (equation.terms.empty()) refuse_card(card, "expected at least one term, found none");
    deck_.equations.push_back(std::move(equation));
  }

  void add_rbe2(const NastranCard& card) {
    DeckCoupling coupling{
        "RBE2 " + card.field(0), nastran_integer(card, 1), 0, nastran_list(card, 3), {}};
    const std::array<bool, 6> given = nastran_components(card, 2);
    std::copy_n(given.begin(), 3, coupling.directions.begin());
    deck_.couplings.push_back(std::move(coupling));
  }

  void add_conm2(const NastranCard& card) {
    DeckMass mass{"CONM2 " + card.field(0),
                  nastran_integer(card, 1),
                  mass_factor_ * nastran_number(card, 3),
                  {},
                  {}};
    const std::int64_t system = nastran_integer_or(card, 2, 0);
    Eigen::Vector3d offset(nastran_number(card, 4), nastran_number(card, 5),
                           nastran_number(card, 6));
    Eigen::Matrix3d inertia;  // Nastran's products of inertia are the positive integrals
    inertia << nastran_number(card, 8), -nastran_number(card, 9), -nastran_number(card, 11),
        -nastran_number(card, 9), nastran_number(card, 10), -nastran_number(card, 12),
        -nastran_number(card, 11), -nastran_number(card, 12), nastran_number(card, 13);
    if (system == -1) {
      offset -= grid_position(card, 1);
    } else if (system != 0) {
      const AxisSystem axes = axes_of(card, system);
      if (axes.is_cylindrical) refuse_card(card, "cylindrical axes are not supported");
      offset = axes.axes * offset;
      inertia = axes.axes * inertia * axes.axes.transpose();
    }
    inertia *= mass_factor_;
    mass.center = {offset[0], offset[1], offset[2]};
    mass.inertia = {inertia(0, 0), inertia(1, 1), inertia(2, 2),
                    inertia(0, 1), inertia(0, 2), inertia(1, 2)};
    deck_.masses.push_back(std::move(mass));
  }

  /// Adds a spring. CELAS2: number, K, G1, C1, G2, C2; CELAS1 has its property in place of K.
  void add_spring(const NastranCard& card) {
    DeckSpring spring{card.name + " " + card.field(0), {}, 0, false};
    if (card.name == "CELAS2") {
      spring.stiffness = nastran_number(card, 1);
    } else {
      const auto found = stiffness_.find(nastran_integer(card, 1));
      if (found == stiffness_.end()) refuse_card(card, "there is no PELAS " + card.field(1));
      spring.stiffness = found->second;
    }
    for (const std::size_t end : {2U, 4U}) {
      if (nastran_integer_or(card, end, 0) == 0) continue;  // ground
      spring.terms.push_back({nastran_integer(card, end), nastran_component(card, end + 1),
                              spring.terms.empty() ? 1.0 : -1.0});
    }
    if (spring.terms.empty()) refuse_card(card, "expected a node, found none");
    deck_.springs.push_back(std::move(spring));
  }

  const std::map<std::int64_t, std::array<double, 3>>& positions_;
  LeftOut& left_out_;
  DeckConnections deck_;
  std::vector<NastranCard> grids_;
  std::optional<NastranCard> grid_set_;
  std::vector<NastranCard> cards_;
  std::map<std::int64_t, std::pair<NastranCard, std::int64_t>> systems_of_grids_;
  std::map<std::int64_t, NastranCard> systems_;
  std::map<std::int64_t, double> stiffness_;
  std::map<std::string, std::map<std::int64_t, std::set<std::int64_t>>> unions_;
  double mass_factor_ = 1;
};

}  // namespace

bool is_nastran_connection(std::string_view name) {
  constexpr std::array<std::string_view, 7> kCards = {"RBE2",  "MPC",    "SPC",   "SPC1",
                                                      "CONM2", "CELAS1", "CELAS2"};
  return std::find(kCards.begin(), kCards.end(), name) != kCards.end();
}

DeckConnections read_nastran_connections(
    const std::vector<NastranCard>& cards, const NastranCaseControl& control,
    const std::map<std::int64_t, std::array<double, 3>>& positions, LeftOut& left_out) {
  ConnectionReader reader(positions, left_out);
  for (const NastranCard& card : cards) reader.read(card);
  return reader.finish(control);
}

}  // namespace flexneck::mesher
