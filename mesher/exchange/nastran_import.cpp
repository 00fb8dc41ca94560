// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/exchange/nastran_import.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include "geometry/foundation/ascii.h"
#include "geometry/foundation/error.h"
#include "mesher/exchange/edge_order.h"
#include "mesher/exchange/foreign_file.h"
#include "mesher/exchange/inp_cards.h"
#include "mesher/exchange/nastran_cards.h"
#include "mesher/exchange/nastran_case_control.h"
#include "mesher/exchange/nastran_connections.h"
#include "mesher/exchange/nastran_fields.h"
#include "mesher/exchange/numbered_mesh.h"

namespace flexneck::mesher {
namespace {

template <std::size_t N>
bool is_among(const std::array<std::string_view, N>& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Cards that add nothing to the structure by themselves: materials (the study gives them),
/// properties of elements, coordinate systems, tables, sums of others, the control of the analysis.
constexpr std::array<std::string_view, 65> kSilent = {
    "MAT1",   "MAT2",   "MAT3",    "MAT4",    "MAT5",    "MAT8",    "MAT9",    "MAT10",  "MATT1",
    "MATS1",  "PSOLID", "PLSOLID", "PSHELL",  "PCOMP",   "PCOMPG",  "PBAR",    "PBARL",  "PBEAM",
    "PBEAML", "PROD",   "PTUBE",   "PELAS",   "PELAST",  "PBUSH",   "PBUSHT",  "PDAMP",  "PMASS",
    "PGAP",   "PWELD",  "PFAST",   "PVISC",   "PSHEAR",  "CORD1R",  "CORD2R",  "CORD1C", "CORD2C",
    "CORD1S", "CORD2S", "EIGR",    "EIGRL",   "EIGB",    "EIGC",    "EIGP",    "SPCADD", "MPCADD",
    "LOAD",   "DLOAD",  "TABLED1", "TABLED2", "TABLED3", "TABLEM1", "TABDMP1", "SET1",   "SET3",
    "FREQ",   "FREQ1",  "FREQ2",   "TSTEP",   "NLPARM",  "GRDSET",  "PARAM",   "GRID",   "PLOTEL",
    "SUPORT", "SUPORT1"};

/// Loads, damping and choices of an approximation: they do not affect the modes of the structure at
/// rest.
constexpr std::array<std::string_view, 39> kLoads = {
    "FORCE",  "FORCE1", "FORCE2", "MOMENT", "MOMENT1", "MOMENT2", "PLOAD",  "PLOAD1",
    "PLOAD2", "PLOAD4", "GRAV",   "RFORCE", "ACCEL",   "ACCEL1",  "TEMP",   "TEMPD",
    "TEMPP1", "TEMPRB", "SPCD",   "SLOAD",  "RLOAD1",  "RLOAD2",  "TLOAD1", "TLOAD2",
    "DAREA",  "DELAY",  "DPHASE", "LSEQ",   "TIC",     "CVISC",   "CDAMP1", "CDAMP2",
    "CDAMP3", "CDAMP4", "ASET",   "ASET1",  "OMIT",    "OMIT1",   "QSET1"};

/// The element that gmsh writes for curves.
constexpr std::string_view kCurve = "CBAR";

struct Solid {
  std::string_view name;
  ElementKind linear;
  ElementKind quadratic;  ///< with all midside nodes
};
constexpr std::array<Solid, 4> kSolids = {
    {{"CHEXA", ElementKind::hex8, ElementKind::hex20},
     {"CPENTA", ElementKind::prism6, ElementKind::prism15},
     {"CTETRA", ElementKind::tet4, ElementKind::tet10},
     {"CPYRAM", ElementKind::pyramid5, ElementKind::pyramid13}}};
struct Shell {
  std::string_view name;
  ElementKind kind;
};
constexpr std::array<Shell, 5> kShells = {{{"CTRIA3", ElementKind::tri3},
                                           {"CTRIA6", ElementKind::tri6},
                                           {"CQUAD4", ElementKind::quad4},
                                           {"CQUAD8", ElementKind::quad8},
                                           {"CQUAD", ElementKind::quad9}}};

template <class Kinds>
auto find_card(const Kinds& kinds, std::string_view name) {
  return std::find_if(kinds.begin(), kinds.end(),
                      [&](const auto& each) { return each.name == name; });
}

/// True for a card's name: letters and digits, eight at most.
bool is_name(const std::string& text) {
  return !text.empty() && text.size() <= 8 &&
         std::all_of(text.begin(), text.end(), is_letter_or_digit);
}

bool is_given(const std::string& field) { return !field.empty() && field != "0"; }

/// Node order as edge_order(), except that in hexahedra and prisms the edges from the lower to the
/// upper face come before those of the upper face (MSC Nastran Quick Reference Guide, CHEXA and
/// CPENTA).
std::vector<std::size_t> nastran_order(ElementKind kind) {
  std::vector<std::size_t> order = edge_order(kind);
  const bool has_upper_face = kind == ElementKind::hex20 || kind == ElementKind::prism15;
  if (has_upper_face) {
    const auto corners = static_cast<std::ptrdiff_t>(corners_per_element(kind));
    const auto upper = order.begin() + corners + corners / 2;
    std::rotate(upper, upper + corners / 2, order.end());
  }
  return order;
}

class ModelReader {
 public:
  ModelReader(bool is_from_gmsh, LeftOut& left_out)
      : is_from_gmsh_(is_from_gmsh), left_out_(left_out) {}

  void read(const NastranCard& card) {
    refuse_unreadable(card);
    const auto* const solid = find_card(kSolids, card.name);
    const auto* const shell = find_card(kShells, card.name);
    if (card.name == "GRID" || card.name == "GRDSET") {
      add_grid(card);
    } else if (card.name == "PARAM") {
      add_parameter(card);
    } else if (card.name == "PSHELL" || card.name == "PCOMP" || card.name == "PCOMPG") {
      stiff_.insert(nastran_integer(card, 0));
    } else if (card.name == "PSOLID" && upper_case(card.field(6)) == "PFLUID") {
      refuse_card(card, "fluids are not supported");
    } else if (solid != kSolids.end()) {
      add_solid(card, *solid);
    } else if (shell != kShells.end()) {
      add_shell(card, *shell);
    } else if (is_among(kLoads, card.name)) {
      left_out_.add(card.name);
    } else if (!is_nastran_connection(card.name) && !is_among(kSilent, card.name) &&
               !(is_from_gmsh_ && card.name == kCurve)) {
      left_out_.add_to_structure(card.name, "line " + std::to_string(card.line));
    }
  }

  NumberedMesh finish() {
    for (auto& [property, elements] : parts_) {
      mesh_.parts.push_back({"volume_" + std::to_string(property), std::move(elements)});
    }
    for (auto& [property, faces] : surfaces_) {
      for (const auto& [name, line] : shells_.at(property)) {
        if (stiff_.count(property) > 0) left_out_.add_to_structure(name, line);
      }
      mesh_.surfaces.push_back({"surface_" + std::to_string(property), std::move(faces)});
    }
    return std::move(mesh_);
  }

 private:
  static void refuse_unreadable(const NastranCard& card) {
    if (card.name == "INCLUDE") {
      refuse_card(card, "including other files is not supported; write the deck as a single file");
    }
    if (card.name.starts_with("=")) refuse_card(card, "replicated cards are not supported");
    if (!is_name(card.name)) refuse_card(card, "not a bulk data card");
    if (card.has_tabs && !is_among(kSilent, card.name) && !is_among(kLoads, card.name)) {
      refuse_tabs(card);
    }
    if (card.has_tabs && (card.name.starts_with("GR") || card.name.starts_with("CORD") ||
                          card.name == "PELAS" || card.name.ends_with("CADD"))) {
      refuse_tabs(card);
    }
  }
  [[noreturn]] static void refuse_tabs(const NastranCard& card) {
    refuse_card(card, "tabs between fixed fields are not supported; use blanks or commas");
  }

  /// Adds a node. Fields: number, CP, three coordinates, CD, PS. GRDSET gives the defaults of CP,
  /// CD and PS.
  void add_grid(const NastranCard& card) {
    if (is_given(card.field(1))) {
      refuse_card(card, "coordinates in system " + card.field(1) +
                            " are not supported; write the deck in the basic system");
    }
    if (card.name == "GRDSET") return;
    try {
      mesh_.add_node(nastran_integer(card, 0),
                     {nastran_number(card, 2), nastran_number(card, 3), nastran_number(card, 4)});
    } catch (const InputError& error) {
      throw InputError("line " + std::to_string(card.line) + ": " + error.what());
    }
  }

  /// Checks a parameter. The scales of matrices are 1 unless given.
  void add_parameter(const NastranCard& card) {
    constexpr std::array<std::string_view, 4> kScales = {"CK1", "CK3", "CM1", "CM2"};
    const std::string name = upper_case(card.field(0));
    if (is_among(kScales, name) && nastran_number(card, 1, 1) != 1) {
      refuse_card(card, name + ": scaled matrices are not supported");
    }
    if (name != "WTMASS" || nastran_number(card, 1, 1) == 1) return;
    left_out_.remark(
        "PARAM,WTMASS " + card.field(1) +
        ": the densities of the deck are weight densities, the study needs mass densities");
  }

  /// Property of an element; its default is the element's number.
  static std::int64_t property_of(const NastranCard& card) {
    return nastran_integer_or(card, 1, nastran_integer(card, 0));
  }

  static NumberedElement element_from(const NastranCard& card, ElementKind kind) {
    const std::vector<std::size_t> order = nastran_order(kind);
    NumberedElement element{nastran_integer(card, 0), kind,
                            std::vector<std::int64_t>(order.size())};
    for (std::size_t k = 0; k < order.size(); ++k) {
      element.nodes[order[k]] = nastran_integer(card, 2 + k);
    }
    return element;
  }

  void add_solid(const NastranCard& card, const Solid& solid) {
    const std::size_t corners = nodes_per_element(solid.linear);
    const std::size_t all = nodes_per_element(solid.quadratic);
    std::size_t given = 0;
    for (std::size_t field = 2; field < card.fields.size(); ++field) {
      if (!card.fields[field].empty()) ++given;
    }
    if (given != corners && given != all) {
      refuse_card(card, "expected " + std::to_string(corners) + " or " + std::to_string(all) +
                            " nodes, found " + std::to_string(given));
    }
    parts_[property_of(card)].push_back(
        element_from(card, given == all ? solid.quadratic : solid.linear));
  }

  void add_shell(const NastranCard& card, const Shell& shell) {
    const std::int64_t property = property_of(card);
    surfaces_[property].push_back(element_from(card, shell.kind));
    shells_[property].push_back({card.name, "line " + std::to_string(card.line)});
  }

  struct Place {
    std::string name;
    std::string line;
  };

  bool is_from_gmsh_;
  LeftOut& left_out_;
  NumberedMesh mesh_;
  std::map<std::int64_t, std::vector<NumberedElement>> parts_;     ///< by property
  std::map<std::int64_t, std::vector<NumberedElement>> surfaces_;  ///< by property
  std::map<std::int64_t, std::vector<Place>> shells_;              ///< by property
  std::set<std::int64_t> stiff_;                                   ///< properties of shells
};

}  // namespace

Mesh import_nastran(const ImportOptions& options, const Progress& /*progress*/, LeftOut& left_out) {
  const std::string text = checked_contents(options.file);
  const NastranCaseControl control = read_nastran_case_control(text, left_out);
  const std::vector<NastranCard> cards = read_nastran_cards(text);
  ModelReader reader(text.starts_with("$ Created by Gmsh"), left_out);
  for (const NastranCard& card : cards) reader.read(card);
  const NumberedMesh file = reader.finish();
  IndexedMesh indexed = indexed_mesh(file, options);
  const DeckConnections deck = read_nastran_connections(cards, control, file.nodes, left_out);
  const std::set<std::int64_t> used = add_connections(
      deck, {file.nodes, indexed.index_of, options.length_unit_m, options.force_unit_N},
      indexed.mesh, left_out);
  const std::size_t loose = file.nodes.size() - indexed.index_of.size() - used.size();
  left_out.add("nodes of no solid element", loose);
  return std::move(indexed.mesh);
}

}  // namespace flexneck::mesher
