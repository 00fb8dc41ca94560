// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/exchange/inp_model.h"

#include <algorithm>
#include <cctype>
#include <set>

#include "geometry/foundation/error.h"
#include "geometry/foundation/names.h"
#include "mesher/exchange/abaqus_elements.h"
#include "mesher/exchange/edge_order.h"
#include "mesher/exchange/inp_sets.h"

namespace flexneck::mesher {
namespace {

class ModelReader {
 public:
  void read(const InpCard& card) {
    const auto found = handlers().find(card.keyword);
    if (found != handlers().end()) {
      (this->*found->second)(card);
    } else if (is_passed_over(card.keyword)) {
      if (ignored_.insert(card.keyword).second) model_.ignored.push_back(card.keyword);
    } else {
      refuse_keyword(card);
    }
  }

  InpModel finish(const std::filesystem::path& file) {
    refuse_other_types(file);
    if (model_.elements.empty()) throw InputError(file.string() + ": it has no *ELEMENT");
    std::sort(model_.elements.begin(), model_.elements.end(),
              [](const InpElement& a, const InpElement& b) { return a.number < b.number; });
    collect_held(file);
    return std::move(model_);
  }

 private:
  using Handler = void (ModelReader::*)(const InpCard&);
  static const std::map<std::string, Handler>& handlers();
  static bool is_passed_over(const std::string& keyword);
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
  void boundary(const InpCard& card);

  InpMaterial& material_of(const InpCard& card) {
    if (model_.materials.empty()) card.refuse("it stands under no *MATERIAL");
    return model_.materials.back();
  }
  static const InpData& only_line_of(const InpCard& card) {
    if (card.data.size() != 1) {
      card.refuse("expected one line of data, found " + std::to_string(card.data.size()) +
                  ": figures that depend on temperature are not supported");
    }
    return card.data.front();
  }
  void refuse_other_types(const std::filesystem::path& file) const;
  void collect_held(const std::filesystem::path& file);

  struct OtherType {
    std::size_t count = 0;
    std::string first;  ///< place
  };

  InpModel model_;
  std::set<std::string> ignored_;
  std::set<std::int64_t> element_numbers_;
  std::map<std::string, OtherType> other_types_;
  std::map<std::int64_t, unsigned> held_directions_;  ///< bits 1, 2, 4
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
      {"SOLID SECTION", &ModelReader::solid_section},
      {"BOUNDARY", &ModelReader::boundary}};
  return kHandlers;
}

/// Steps, loads, output and further properties of materials: they change neither mesh nor modes.
bool ModelReader::is_passed_over(const std::string& keyword) {
  static const std::set<std::string> kPassedOver = {"AMPLITUDE",
                                                    "BUCKLE",
                                                    "CFLUX",
                                                    "CLOAD",
                                                    "CONDUCTIVITY",
                                                    "CONTACT FILE",
                                                    "CONTACT PRINT",
                                                    "CONTROLS",
                                                    "DAMPING",
                                                    "DFLUX",
                                                    "DLOAD",
                                                    "DSLOAD",
                                                    "DYNAMIC",
                                                    "EL FILE",
                                                    "EL PRINT",
                                                    "ELEMENT OUTPUT",
                                                    "END STEP",
                                                    "EXPANSION",
                                                    "FREQUENCY",
                                                    "HEADING",
                                                    "INITIAL CONDITIONS",
                                                    "MODAL DAMPING",
                                                    "MODAL DYNAMIC",
                                                    "NODE FILE",
                                                    "NODE OUTPUT",
                                                    "NODE PRINT",
                                                    "OUTPUT",
                                                    "PHYSICAL CONSTANTS",
                                                    "PREPRINT",
                                                    "RESTART",
                                                    "SOLVER",
                                                    "SPECIFIC HEAT",
                                                    "STATIC",
                                                    "STEADY STATE DYNAMICS",
                                                    "STEP",
                                                    "TEMPERATURE",
                                                    "TIME POINTS"};
  return kPassedOver.count(keyword) > 0;
}

void ModelReader::refuse_keyword(const InpCard& card) {
  static const std::set<std::string> kAssembly = {"PART",         "END PART", "ASSEMBLY",
                                                  "END ASSEMBLY", "INSTANCE", "END INSTANCE"};
  if (kAssembly.count(card.keyword) > 0) {
    card.refuse(
        "parts and instances are not supported; write a flat input, in Abaqus/CAE with "
        "mdb.models['…'].setValues(noPartsInputFile=ON)");
  }
  std::vector<std::string> known;
  for (const auto& [keyword, handler] : handlers()) known.push_back(keyword);
  card.refuse("this keyword is not known here, and it may change the structure; remove it" +
              did_you_mean(known, card.keyword));
}

void ModelReader::nodes(const InpCard& card) {
  if (card.has("SYSTEM") && upper_case(card.parameter("SYSTEM")) != "R") {
    card.refuse("only rectangular coordinates are supported");
  }
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
                       " comes twice, in different places");
    }
  }
  if (card.has("NSET")) add_to_inp_set(model_.nsets, card.parameter("NSET"), numbers);
}

void ModelReader::elements(const InpCard& card) {
  const std::string type = upper_case(card.parameter("TYPE"));
  const auto kind = kind_of_abaqus_type(type);
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
      throw InputError(place.text() + "element " + std::to_string(element.number) + " comes twice");
    }
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
  if (card.has("TYPE") && upper_case(card.parameter("TYPE")) != "ELEMENT") {
    card.refuse("only TYPE=ELEMENT is supported; a set of nodes is an *NSET");
  }
  InpSurface surface{card.parameter("NAME"), {}};
  for (const InpData& line : card.data) {
    const std::string side = line.fields.size() > 1 ? upper_case(line.fields[1]) : "";
    if (side.size() != 2 || side[0] != 'S' || side[1] < '1' || side[1] > '6') {
      throw InputError(line.place.text() + "expected an element or ELSET and its side S1 … S6");
    }
    for (const std::int64_t element : inp_members_of(line, 0, model_.elsets, "ELSET")) {
      surface.sides.push_back({element, static_cast<std::size_t>(side[1] - '1')});
    }
  }
  model_.surfaces.push_back(std::move(surface));
}

void ModelReader::elastic(const InpCard& card) {
  if (card.has("TYPE") && !upper_case(card.parameter("TYPE")).starts_with("ISO")) {
    card.refuse("only isotropic materials are supported");
  }
  InpMaterial& material = material_of(card);
  material.youngs_modulus = inp_number(only_line_of(card), 0);
  material.poissons_ratio = inp_number(only_line_of(card), 1);
}

void ModelReader::solid_section(const InpCard& card) {
  if (card.has("ORIENTATION")) card.refuse("ORIENTATION is not supported");
  model_.sections.push_back({card.place, card.parameter("ELSET"), card.parameter("MATERIAL")});
}

void ModelReader::boundary(const InpCard& card) {
  if (card.has("TYPE") && upper_case(card.parameter("TYPE")) != "DISPLACEMENT") {
    card.refuse("only displacements are supported");
  }
  for (const InpData& line : card.data) {
    unsigned directions = 0;
    const std::string second = line.fields.size() > 1 ? upper_case(line.fields[1]) : "";
    if (second == "ENCASTRE" || second == "PINNED") {
      directions = 7;
    } else {
      const std::int64_t first = inp_integer(line, 1);
      const bool has_last = line.fields.size() > 2 && !line.fields[2].empty();
      const std::int64_t last = has_last ? inp_integer(line, 2) : first;
      for (std::int64_t d = first; d <= std::min<std::int64_t>(last, 3); ++d) {
        if (d >= 1) directions |= 1U << (d - 1);
      }
    }
    if (line.fields.size() > 3 && !line.fields[3].empty() && inp_number(line, 3) != 0) {
      throw InputError(line.place.text() + "*BOUNDARY: expected displacements of zero");
    }
    for (const std::int64_t node : inp_members_of(line, 0, model_.nsets, "NSET")) {
      held_directions_[node] |= directions;
    }
  }
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

void ModelReader::collect_held(const std::filesystem::path& file) {
  for (const auto& [node, directions] : held_directions_) {
    if (directions == 7) model_.held.push_back(node);
    if (directions == 7 || directions == 0) continue;
    throw InputError(file.string() + ": *BOUNDARY holds node " + std::to_string(node) +
                     " in some directions only; a node is held in all three or in none");
  }
}

}  // namespace

InpModel read_inp(const std::filesystem::path& file, const std::string& text) {
  ModelReader reader;
  for (const InpCard& card : read_inp_cards(file, text)) reader.read(card);
  return reader.finish(file);
}

}  // namespace flexneck::mesher
