// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/exchange/inp_model.h"

#include <algorithm>
#include <cctype>
#include <set>

#include "geometry/foundation/error.h"
#include "geometry/foundation/names.h"
#include "mesher/exchange/abaqus_elements.h"
#include "mesher/exchange/edge_order.h"
#include "mesher/exchange/inp_connections.h"
#include "mesher/exchange/inp_keywords.h"
#include "mesher/exchange/inp_sets.h"

namespace flexneck::mesher {
namespace {

class ModelReader {
 public:
  void read(const InpCard& card) {
    if (card.keyword == "FREQUENCY") frequencies_ = "line " + std::to_string(card.place.line);
    if (card.keyword == "STEP" && !frequencies_.empty()) is_behind_frequencies_ = true;
    if (is_behind_frequencies_ && card.keyword == "BOUNDARY") {
      card.refuse("it belongs to a step after the *FREQUENCY in " + frequencies_ +
                  ", whose modes do not include it; remove that step");
    }
    const auto row = inp_keywords().find(card.keyword);
    if (row == inp_keywords().end() || row->second.use == InpUse::assembly) refuse_keyword(card);
    check_parameters(card, row->second);
    const auto found = handlers().find(card.keyword);
    if (found != handlers().end()) {
      (this->*found->second)(card);
    } else if (row->second.use == InpUse::read) {
      connections_.read(card, model_);
    } else if (row->second.use == InpUse::left_out) {
      model_.left_out.add("*" + card.keyword);
    } else {
      if (ignored_.insert(card.keyword).second) model_.ignored.push_back(card.keyword);
      notice_preload(card);
    }
  }

  InpModel finish(const std::filesystem::path& file) {
    refuse_other_types(file);
    check_members(model_.nsets, "NSET", "node", model_.nodes);
    check_members(model_.elsets, "ELSET", "element", element_numbers_);
    if (model_.elements.empty())
      throw InputError(file.string() + ": expected at least one *ELEMENT, found none");
    std::sort(model_.elements.begin(), model_.elements.end(),
              [](const InpElement& a, const InpElement& b) { return a.number < b.number; });
    collect_connections();
    return std::move(model_);
  }

 private:
  using Handler = void (ModelReader::*)(const InpCard&);
  static const std::map<std::string, Handler>& handlers();
  [[noreturn]] static void refuse_keyword(const InpCard& card);

  void nodes(const InpCard& card);
  void elements(const InpCard& card);
  void elset(const InpCard& card) { read_inp_set(card, "ELSET", model_.elsets); }
  void nset(const InpCard& card) { read_inp_set(card, "NSET", model_.nsets); }
  void surface(const InpCard& card);
  void material(const InpCard& card) {
    model_.materials.push_back({card.parameter("NAME"), {}, {}, {}});
  }
  void elastic(const InpCard& card);
  void density(const InpCard& card) {
    material_of(card).density = inp_number(only_line_of(card), 0);
  }
  void solid_section(const InpCard& card);

  InpMaterial& material_of(const InpCard& card) {
    if (model_.materials.empty()) card.refuse("expected it after *MATERIAL");
    return model_.materials.back();
  }
  static const InpData& only_line_of(const InpCard& card) {
    if (card.data.size() != 1) {
      card.refuse("expected one line of data, found " + std::to_string(card.data.size()) +
                  "; temperature-dependent values are not supported");
    }
    return card.data.front();
  }
  void notice_preload(const InpCard& card);
  void refuse_other_types(const std::filesystem::path& file) const;
  template <class Known>
  void check_members(const InpSets& sets, const std::string& kind, const std::string& member,
                     const Known& known);
  void collect_connections();

  struct OtherType {
    std::size_t count = 0;
    std::string first;  ///< place of the first
  };

  InpModel model_;
  std::set<std::string> ignored_;
  std::string frequencies_;  ///< place of the last *FREQUENCY
  bool is_behind_frequencies_ = false;
  std::string preload_;  ///< place of the last *STATIC
  std::set<std::int64_t> element_numbers_;
  std::map<std::string, OtherType> other_types_;
  InpConnectionReader connections_;
};

const std::map<std::string, ModelReader::Handler>& ModelReader::handlers() {
  static const std::map<std::string, Handler> kHandlers = {
      {"NODE", &ModelReader::nodes},
      {"ELEMENT", &ModelReader::elements},
      {"ELSET", &ModelReader::elset},
      {"NSET", &ModelReader::nset},
      {"SURFACE", &ModelReader::surface},
      {"MATERIAL", &ModelReader::material},
      {"ELASTIC", &ModelReader::elastic},
      {"DENSITY", &ModelReader::density},
      {"SOLID SECTION", &ModelReader::solid_section}};
  return kHandlers;
}

/// Remarks that modes after a static step would be those of the preloaded structure.
void ModelReader::notice_preload(const InpCard& card) {
  if (card.keyword == "STATIC") preload_ = "line " + std::to_string(card.place.line);
  if (card.keyword != "FREQUENCY" || preload_.empty()) return;
  model_.left_out.remark("the preload of *STATIC in " + preload_ +
                         ": modes are those of the unloaded structure");
  preload_.clear();
}

void ModelReader::refuse_keyword(const InpCard& card) {
  if (inp_keywords().count(card.keyword) > 0) {
    card.refuse(
        "parts and instances are not supported; write a flat input file, in Abaqus/CAE with "
        "mdb.models['…'].setValues(noPartsInputFile=ON)");
  }
  std::vector<std::string> known;
  for (const auto& [keyword, row] : inp_keywords()) known.push_back(keyword);
  card.refuse("the keyword is unknown and may change the structure; remove it" +
              did_you_mean(known, card.keyword));
}

void ModelReader::nodes(const InpCard& card) {
  std::vector<std::int64_t> numbers;
  for (const InpData& line : card.data) {
    std::array<double, 3> x{};
    for (std::size_t d = 0; d < 3 && d + 1 < line.fields.size(); ++d) {
      x[d] = line.fields[d + 1].empty() ? 0 : inp_number(line, d + 1);
    }
    numbers.push_back(inp_integer(line, 0));
    const auto [entry, is_new] = model_.nodes.emplace(numbers.back(), x);
    if (!is_new && entry->second != x) {
      throw InputError(line.place.text() + "node " + std::to_string(numbers.back()) +
                       " is defined twice, at different positions");
    }
  }
  if (card.has("NSET")) add_to_inp_set(model_.nsets, card.parameter("NSET"), numbers);
}

void ModelReader::elements(const InpCard& card) {
  const std::string type = upper_case(card.parameter("TYPE"));
  const auto kind = kind_of_abaqus_type(type);
  if (InpPointElements::has(type)) {
    for (const std::int64_t number : connections_.elements(card, type)) {
      element_numbers_.insert(number);
    }
    return;
  }
  if (!kind) {
    OtherType& other = other_types_[type];
    if (other.count == 0) other.first = card.place.text();
    bool is_continued = false;
    for (const InpData& line : card.data) {
      if (!is_continued) ++other.count;
      is_continued = line.ends_in_comma;
    }
    return;
  }
  const std::vector<std::size_t> order = edge_order(*kind);
  std::vector<std::int64_t> numbers;
  for (std::size_t l = 0; l < card.data.size(); ++l) {
    const InpPlace& place = card.data[l].place;
    std::vector<std::int64_t> row;
    for (; l < card.data.size(); ++l) {
      for (std::size_t f = 0; f < card.data[l].fields.size(); ++f) {
        row.push_back(inp_integer(card.data[l], f));
      }
      if (row.size() >= order.size() + 1) break;
    }
    if (row.size() != order.size() + 1) {
      throw InputError(place.text() + "expected a number and " + std::to_string(order.size()) +
                       " nodes of a " + type + ", found " + std::to_string(row.size()) + " fields");
    }
    InpElement element{row.front(), *kind, std::vector<std::int64_t>(order.size())};
    for (std::size_t k = 0; k < order.size(); ++k) element.nodes[order[k]] = row[k + 1];
    if (!element_numbers_.insert(element.number).second) {
      throw InputError(place.text() + "element " + std::to_string(element.number) +
                       " is defined twice");
    }
    ++model_.types[type];
    numbers.push_back(element.number);
    model_.elements.push_back(std::move(element));
  }
  if (!card.has("ELSET")) return;
  add_to_inp_set(model_.elsets, card.parameter("ELSET"), numbers);
  const std::string name = upper_case(card.parameter("ELSET"));
  auto& names = model_.element_elsets;
  if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
}

void ModelReader::surface(const InpCard& card) {
  InpSurface surface{card.parameter("NAME"), {}};
  for (const InpData& line : card.data) {
    const std::string side = line.fields.size() > 1 ? upper_case(line.fields[1]) : "";
    if (side.size() != 2 || side[0] != 'S' || side[1] < '1' || side[1] > '6') {
      throw InputError(line.place.text() + "expected an element or ELSET and its face S1 … S6");
    }
    for (const std::int64_t element : inp_members_of(line, 0, model_.elsets, "ELSET")) {
      surface.sides.push_back({element, static_cast<std::size_t>(side[1] - '1')});
    }
  }
  model_.surfaces.push_back(std::move(surface));
}

void ModelReader::elastic(const InpCard& card) {
  InpMaterial& material = material_of(card);
  material.youngs_modulus = inp_number(only_line_of(card), 0);
  material.poissons_ratio = inp_number(only_line_of(card), 1);
}

void ModelReader::solid_section(const InpCard& card) {
  model_.sections.push_back({card.place, card.parameter("ELSET"), card.parameter("MATERIAL")});
}

void ModelReader::refuse_other_types(const std::filesystem::path& file) const {
  if (other_types_.empty()) return;
  std::string found;
  for (const auto& [type, other] : other_types_) {
    found += (found.empty() ? "" : ", ") + std::to_string(other.count) + " of type " + type +
             " (first at " + other.first.substr(0, other.first.size() - 2) + ")";
  }
  throw InputError(file.string() + ": elements of types that are not supported: " + found +
                   "; supported are " + known_abaqus_types());
}

/// Checks the members of the sets. A number within a range may be undefined; one that is written
/// out must not be.
/// @param kind NSET or ELSET
/// @param member node or element
template <class Known>
void ModelReader::check_members(const InpSets& sets, const std::string& kind,
                                const std::string& member, const Known& known) {
  const auto is_unknown = [&](std::int64_t number) { return known.count(number) == 0; };
  const std::string keyword = ", which *" + upper_case(member) + " does not define";
  for (const auto& [key, set] : sets) {
    const auto wrong = std::find_if(set.written.begin(), set.written.end(), is_unknown);
    if (wrong != set.written.end()) {
      throw InputError("*" + kind + " '" + set.name + "' has " + member + " " +
                       std::to_string(*wrong) + keyword);
    }
    const auto missing = std::count_if(set.members.begin(), set.members.end(), is_unknown);
    model_.left_out.add(member + "s in the ranges of *" + kind + " '" + set.name + "'" + keyword,
                        static_cast<std::size_t>(missing));
  }
}

void ModelReader::collect_connections() {
  for (const std::int64_t node : connections_.supported_by_number()) {
    if (model_.nodes.count(node) > 0) continue;
    throw InputError("*BOUNDARY fixes node " + std::to_string(node) +
                     ", which *NODE does not define");
  }
  model_.connections = connections_.finish(model_);
  for (const DeckSupport& support : model_.connections.supports) {
    const auto& fixed = support.components;
    if (fixed[0] && fixed[1] && fixed[2]) model_.fixed.push_back(support.node);
  }
  const auto named = model_.nsets.find("BOUNDARY");
  if (named != model_.nsets.end() && !model_.fixed.empty() &&
      named->second.members != model_.fixed) {
    throw InputError(
        "the NSET '" + named->second.name +
        "' has other nodes than the set of this name that is made from *BOUNDARY; rename it");
  }
}

}  // namespace

InpModel read_inp(const std::filesystem::path& file, const std::string& text) {
  ModelReader reader;
  for (const InpCard& card : read_inp_cards(file, text)) reader.read(card);
  return reader.finish(file);
}

}  // namespace flexneck::mesher
