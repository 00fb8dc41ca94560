// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/exchange/nastran_connections.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <optional>
#include <set>
#include <string>

#include <Eigen/Geometry>

#include "geometry/foundation/error.h"
#include "mesher/exchange/inp_cards.h"
#include "mesher/exchange/nastran_cards.h"
#include "mesher/exchange/text_lines.h"

namespace flexneck::mesher {
namespace {

[[noreturn]] void refuse(const NastranCard& card, const std::string& problem) {
  throw InputError("line " + std::to_string(card.line) + ": " + card.name + ": " + problem);
}

std::int64_t integer(const NastranCard& card, std::size_t field) {
  const std::string& text = card.field(field);
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) {
    refuse(card, "expected a whole number in field " + std::to_string(field + 2) + ", found '" +
                     text + "'");
  }
  return value;
}

std::int64_t integer_or(const NastranCard& card, std::size_t field, std::int64_t fallback) {
  return card.field(field).empty() ? fallback : integer(card, field);
}

/// Nastran's reals may leave out the letter of the exponent: 1.5-3.
double real(const NastranCard& card, std::size_t field, double fallback = 0) {
  std::string text = card.field(field);
  if (text.empty()) return fallback;
  for (char& c : text) {
    if (c == 'D' || c == 'd' || c == 'E') c = 'e';
  }
  if (text.find('e') == std::string::npos) {
    const std::size_t sign = text.find_last_of("+-");
    if (sign != std::string::npos && sign > 0) text.insert(sign, "e");
  }
  const std::string_view digits = std::string_view(text).substr(text.front() == '+' ? 1 : 0);
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc() || end != digits.data() + digits.size() || !std::isfinite(value)) {
    refuse(card, "expected a number in field " + std::to_string(field + 2) + ", found '" +
                     card.field(field) + "'");
  }
  return value;
}

/// "123" to 1, 2, 3.
std::array<bool, 6> components(const NastranCard& card, std::size_t field) {
  std::array<bool, 6> result{};
  for (const char c : card.field(field)) {
    if (c == '0') continue;
    if (c < '1' || c > '6') {
      refuse(card, "expected components from 1 to 6, found '" + card.field(field) + "'");
    }
    result[static_cast<std::size_t>(c - '1')] = true;
  }
  return result;
}

int component(const NastranCard& card, std::size_t field) {
  const std::int64_t value = integer_or(card, field, 0);
  if (value < 1 || value > 6) {
    refuse(card, "expected a component from 1 to 6, found '" + card.field(field) + "'");
  }
  return static_cast<int>(value);
}

/// Numbers from a field on, with "first THRU last"; a real behind them ends the list.
std::vector<std::int64_t> list_from(const NastranCard& card, std::size_t field) {
  constexpr std::int64_t kMost = 10'000'000;
  std::vector<std::int64_t> numbers;
  for (; field < card.fields.size(); ++field) {
    const std::string& text = card.field(field);
    if (text.empty()) continue;
    if (text.find('.') != std::string::npos) break;
    if (upper_case(text) != "THRU") {
      numbers.push_back(integer(card, field));
      continue;
    }
    const std::int64_t last = integer(card, ++field);
    if (numbers.empty() || last < numbers.back() || last - numbers.back() > kMost) {
      refuse(card, "expected a range with THRU");
    }
    while (numbers.back() < last) numbers.push_back(numbers.back() + 1);
  }
  return numbers;
}

/// Sets that "SPC = 1" and "MPC = 2" of the case control select.
struct CaseControl {
  bool is_there = false;
  std::map<std::string, std::set<std::int64_t>> sets;
};

CaseControl read_case_control(std::string_view text) {
  CaseControl control;
  TextLines lines(text);
  while (const auto line = lines.next()) {
    const std::string words = upper_case(trimmed(*line));
    if (words.starts_with("BEGIN")) {
      control.is_there = true;
      return control;
    }
    const std::size_t equals = words.find('=');
    if (equals == std::string::npos) continue;
    const std::string name(trimmed(std::string_view(words).substr(0, equals)));
    const std::string value(trimmed(std::string_view(words).substr(equals + 1)));
    std::int64_t number = 0;
    const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
    if (error == std::errc() && end == value.data() + value.size()) {
      control.sets[name].insert(number);
    }
  }
  return {};
}

class Reader {
 public:
  explicit Reader(LeftOut& left_out) : left_out_(left_out) {}

  void read(const NastranCard& card) {
    if (card.name == "GRID") {
      grids_.push_back(card);
    } else if (card.name == "GRDSET") {
      grid_set_ = card;
    } else if (card.name.starts_with("CORD")) {
      systems_[integer(card, 0)] = card;
    } else if (card.name == "CHEXA" || card.name == "CPENTA" || card.name == "CTETRA" ||
               card.name == "CPYRAM") {
      for (const std::int64_t node : list_from(card, 2)) solid_nodes_.insert(node);
    } else if (card.name == "PELAS") {
      for (std::size_t first = 0; first + 1 < card.fields.size(); first += 4) {
        if (!card.field(first).empty()) stiffness_[integer(card, first)] = real(card, first + 1);
      }
    } else if (card.name == "PARAM" && card.field(0) == "WTMASS") {
      mass_factor_ = real(card, 1, 1);
    } else if (card.name == "SPCADD" || card.name == "MPCADD") {
      const std::vector<std::int64_t> sets = list_from(card, 1);
      unions_[card.name.substr(0, 3)][integer(card, 0)] = {sets.begin(), sets.end()};
    } else if (is_nastran_connection(card.name)) {
      cards_.push_back(card);
    }
  }

  NastranConnections finish(const CaseControl& control) {
    for (const NastranCard& grid : grids_) add_grid(grid);
    const std::set<std::int64_t> spc = selected("SPC", control);
    const std::set<std::int64_t> mpc = selected("MPC", control);
    for (const NastranCard& card : cards_) {
      const std::string kind = card.name.substr(0, 3);
      if (kind == "SPC" || kind == "MPC") {
        if ((kind == "SPC" ? spc : mpc).count(integer(card, 0)) == 0) {
          left_out_.add(card.name + " of sets that are not selected");
          continue;
        }
      }
      add(card);
    }
    result_.solid_nodes.assign(solid_nodes_.begin(), solid_nodes_.end());
    return std::move(result_);
  }

 private:
  /// Sets that act, those of SPCADD and MPCADD by their parts.
  std::set<std::int64_t> selected(const std::string& kind, const CaseControl& control) {
    std::set<std::int64_t> there;
    for (const NastranCard& card : cards_) {
      if (card.name.starts_with(kind)) there.insert(integer(card, 0));
    }
    std::set<std::int64_t> chosen;
    if (control.is_there) {
      const auto found = control.sets.find(kind);
      if (found != control.sets.end()) chosen = found->second;
    } else if (unions_[kind].size() == 1) {
      chosen = {unions_[kind].begin()->first};
    } else {
      chosen = there;
    }
    if (chosen.size() > 1) {
      left_out_.remark("there are several sets of " + kind + " and none is the one to take");
      return {};
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
    const std::int64_t number = integer(card, 0);
    result_.positions[number] = {real(card, 2), real(card, 3), real(card, 4)};
    NastranCard with_defaults = card;
    with_defaults.fields.resize(std::max<std::size_t>(card.fields.size(), 8));
    for (const std::size_t field : {5U, 6U}) with_defaults.fields[field] = grid_field(card, field);
    const std::int64_t system = integer_or(with_defaults, 5, 0);
    const std::array<bool, 6> fixed = components(with_defaults, 6);
    if (fixed != std::array<bool, 6>{}) result_.deck.supports.push_back({"GRID", number, fixed});
    if (system != 0) result_.deck.axes[number] = axes_of(card, system);
  }

  Eigen::Vector3d grid_position(const NastranCard& card, std::size_t field) const {
    for (const NastranCard& grid : grids_) {
      if (integer(grid, 0) == integer(card, field)) {
        return {real(grid, 2), real(grid, 3), real(grid, 4)};
      }
    }
    refuse(card, "there is no GRID " + card.field(field));
  }

  AxisSystem axes_of(const NastranCard& user, std::int64_t number) const {
    const auto found = systems_.find(number);
    if (found == systems_.end()) {
      refuse(user, "there is no coordinate system " + std::to_string(number));
    }
    const NastranCard& card = found->second;
    const bool by_grids = card.name == "CORD1R" || card.name == "CORD1C";
    if (!by_grids && card.name != "CORD2R" && card.name != "CORD2C") {
      refuse(card, "supports and the like in such a coordinate system are not supported");
    }
    std::array<Eigen::Vector3d, 3> points;
    if (by_grids) {
      for (std::size_t k = 0; k < 3; ++k) points[k] = grid_position(card, k + 1);
    } else {
      if (integer_or(card, 1, 0) != 0) {
        refuse(card,
               "a coordinate system in another one is not supported; write it in the basic "
               "system");
      }
      for (std::size_t k = 0; k < 3; ++k) {
        points[k] = {real(card, 3 * k + 2), real(card, 3 * k + 3), real(card, 3 * k + 4)};
      }
    }
    AxisSystem axes;
    axes.origin_m = points[0];  // in the deck's unit
    axes.is_cylindrical = card.name.back() == 'C';
    try {
      axes.axes = axes_from(points[1] - points[0], points[2] - points[0]);
    } catch (const InputError& error) {
      refuse(card, error.what());
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
      if (real(card, first + 2) != 0) refuse(card, "expected displacements of zero");
      result_.deck.supports.push_back(
          {"SPC " + card.field(0), integer(card, first), components(card, first + 1)});
    }
  }

  void add_spc1(const NastranCard& card) {
    for (const std::int64_t node : list_from(card, 2)) {
      if (result_.positions.count(node) == 0) continue;  // of a range
      result_.deck.supports.push_back({"SPC1 " + card.field(0), node, components(card, 1)});
    }
  }

  void add_mpc(const NastranCard& card) {
    DeckEquation equation{"MPC " + card.field(0) + " in line " + std::to_string(card.line), {}};
    for (std::size_t line = 0; line < card.fields.size(); line += 8) {
      for (const std::size_t first : {line + 1, line + 4}) {
        if (card.field(first).empty()) continue;
        equation.terms.push_back(
            {integer(card, first), component(card, first + 1), real(card, first + 2)});
      }
    }
    if (equation.terms.empty()) refuse(card, "it has no terms");
    result_.deck.equations.push_back(std::move(equation));
  }

  void add_rbe2(const NastranCard& card) {
    DeckCoupling coupling{"RBE2 " + card.field(0), integer(card, 1), 0, list_from(card, 3), {}};
    const std::array<bool, 6> given = components(card, 2);
    std::copy_n(given.begin(), 3, coupling.directions.begin());
    result_.deck.couplings.push_back(std::move(coupling));
  }

  void add_conm2(const NastranCard& card) {
    DeckMass mass{"CONM2 " + card.field(0), integer(card, 1), mass_factor_ * real(card, 3), {}, {}};
    const std::int64_t system = integer_or(card, 2, 0);
    Eigen::Vector3d offset(real(card, 4), real(card, 5), real(card, 6));
    Eigen::Matrix3d inertia;  // Nastran gives the integrals of products
    inertia << real(card, 8), -real(card, 9), -real(card, 11), -real(card, 9), real(card, 10),
        -real(card, 12), -real(card, 11), -real(card, 12), real(card, 13);
    if (system == -1) {
      const auto found = result_.positions.find(mass.node);
      if (found == result_.positions.end()) refuse(card, "there is no GRID " + card.field(1));
      offset -= Eigen::Vector3d(found->second.data());
    } else if (system != 0) {
      const AxisSystem axes = axes_of(card, system);
      if (axes.is_cylindrical) refuse(card, "cylindrical axes are not supported");
      offset = axes.axes * offset;
      inertia = axes.axes * inertia * axes.axes.transpose();
    }
    inertia *= mass_factor_;
    mass.center = {offset[0], offset[1], offset[2]};
    mass.inertia = {inertia(0, 0), inertia(1, 1), inertia(2, 2),
                    inertia(0, 1), inertia(0, 2), inertia(1, 2)};
    result_.deck.masses.push_back(std::move(mass));
  }

  /// CELAS2: number, K, G1, C1, G2, C2; CELAS1 has its property in place of K.
  void add_spring(const NastranCard& card) {
    DeckSpring spring{card.name + " " + card.field(0), {}, 0, false};
    if (card.name == "CELAS2") {
      spring.stiffness = real(card, 1);
    } else {
      const auto found = stiffness_.find(integer(card, 1));
      if (found == stiffness_.end()) refuse(card, "there is no PELAS " + card.field(1));
      spring.stiffness = found->second;
    }
    for (const std::size_t end : {2U, 4U}) {
      if (integer_or(card, end, 0) == 0) continue;  // ground
      spring.terms.push_back(
          {integer(card, end), component(card, end + 1), spring.terms.empty() ? 1.0 : -1.0});
    }
    if (spring.terms.empty()) refuse(card, "it joins no nodes");
    result_.deck.springs.push_back(std::move(spring));
  }

  LeftOut& left_out_;
  NastranConnections result_;
  std::vector<NastranCard> grids_;
  std::optional<NastranCard> grid_set_;
  std::vector<NastranCard> cards_;
  std::map<std::int64_t, NastranCard> systems_;
  std::map<std::int64_t, double> stiffness_;
  std::map<std::string, std::map<std::int64_t, std::set<std::int64_t>>> unions_;
  std::set<std::int64_t> solid_nodes_;
  double mass_factor_ = 1;
};

}  // namespace

bool is_nastran_connection(std::string_view name) {
  constexpr std::array<std::string_view, 7> kCards = {"RBE2",  "MPC",    "SPC",   "SPC1",
                                                      "CONM2", "CELAS1", "CELAS2"};
  return std::find(kCards.begin(), kCards.end(), name) != kCards.end();
}

NastranConnections read_nastran_connections(std::string_view text, LeftOut& left_out) {
  Reader reader(left_out);
  for_each_nastran_card(text, [&](const NastranCard& card) { reader.read(card); });
  return reader.finish(read_case_control(text));
}

}  // namespace flexneck::mesher
