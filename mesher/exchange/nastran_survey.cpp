// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>
#include <string>

#include "geometry/foundation/error.h"
#include "mesher/exchange/file_survey.h"
#include "mesher/exchange/nastran_cards.h"
#include "mesher/exchange/nastran_connections.h"

namespace flexneck::mesher {
namespace {

template <std::size_t N>
bool is_among(const std::array<std::string_view, N>& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Cards that add nothing to the structure by themselves: materials, properties of elements,
/// coordinate systems, tables, sums of others, the control of the analysis.
constexpr std::array<std::string_view, 61> kSilent = {
    "MAT1",   "MAT2",   "MAT3",    "MAT4",    "MAT5",    "MAT8",    "MAT9",   "MAT10",  "MATT1",
    "MATS1",  "PSOLID", "PLSOLID", "PSHELL",  "PCOMP",   "PCOMPG",  "PBAR",   "PBARL",  "PBEAM",
    "PBEAML", "PROD",   "PTUBE",   "PELAS",   "PELAST",  "PBUSH",   "PBUSHT", "PDAMP",  "PMASS",
    "PGAP",   "PWELD",  "PFAST",   "PVISC",   "PSHEAR",  "CORD1R",  "CORD2R", "CORD1C", "CORD2C",
    "CORD1S", "CORD2S", "EIGR",    "EIGRL",   "EIGB",    "EIGC",    "EIGP",   "SPCADD", "MPCADD",
    "LOAD",   "DLOAD",  "TABLED1", "TABLED2", "TABLEM1", "TABDMP1", "SET1",   "SET3",   "FREQ",
    "FREQ1",  "FREQ2",  "TSTEP",   "NLPARM",  "GRDSET",  "PARAM",   "GRID"};

/// What gmsh writes for faces and curves.
constexpr std::array<std::string_view, 6> kFacesAndCurves = {"CTRIA3", "CTRIA6", "CQUAD4",
                                                             "CQUAD8", "CQUAD",  "CBAR"};

struct Solid {
  std::string_view name;
  std::size_t corners;
  std::size_t nodes;  ///< with all midside nodes
};
constexpr std::array<Solid, 4> kSolids = {
    {{"CHEXA", 8, 20}, {"CPENTA", 6, 15}, {"CTETRA", 4, 10}, {"CPYRAM", 5, 13}}};

[[noreturn]] void refuse(const NastranCard& card, const std::string& problem) {
  throw InputError("line " + std::to_string(card.line) + ": " + card.name + ": " + problem);
}

/// Letters and digits, eight at most, as every card's name is.
bool is_name(const std::string& text) {
  return text.size() <= 8 && std::all_of(text.begin(), text.end(),
                                         [](unsigned char c) { return std::isalnum(c) != 0; });
}

bool is_given(const std::string& field) { return !field.empty() && field != "0"; }

class Surveyor {
 public:
  Surveyor(bool is_from_gmsh, LeftOut& left_out)
      : is_from_gmsh_(is_from_gmsh), left_out_(&left_out) {}

  void read(const NastranCard& card) {
    const auto* const solid = std::find_if(
        kSolids.begin(), kSolids.end(), [&](const Solid& each) { return each.name == card.name; });
    refuse_unreadable(card, solid != kSolids.end());
    if (card.name == "GRID" || card.name == "GRDSET") {
      add_grid(card);
    } else if (card.name == "PARAM") {
      add_parameter(card);
    } else if (solid != kSolids.end()) {
      add_solid(card, *solid);
    } else if (is_nastran_connection(card.name)) {
      survey_.has_connections = true;
    } else if (!is_among(kSilent, card.name) &&
               !(is_from_gmsh_ && is_among(kFacesAndCurves, card.name))) {
      left_out_->add(is_name(card.name) ? card.name : "lines that are no cards");
    }
  }

  const FileSurvey& survey() const { return survey_; }

 private:
  static void refuse_unreadable(const NastranCard& card, bool is_solid) {
    if (card.name == "INCLUDE") {
      refuse(card, "other files are not followed; write the deck as one file");
    }
    if (card.name.starts_with("=")) refuse(card, "replicated cards are not supported");
    if (card.has_tabs && (is_solid || card.name == "GRID")) {
      refuse(card, "tabs between fixed fields are not supported; take blanks or commas");
    }
  }

  /// Fields: number, CP, three coordinates, CD, PS. A GRDSET gives CP, CD and PS where a GRID has
  /// none.
  void add_grid(const NastranCard& card) {
    if (is_given(card.field(1))) {
      refuse(card, "coordinates in system " + card.field(1) +
                       " are not supported; write the deck in the basic system");
    }
    survey_.has_connections = survey_.has_connections || is_given(card.field(6));
    if (card.name == "GRID") ++survey_.nodes;
  }

  void add_parameter(const NastranCard& card) {
    if (card.field(0) != "WTMASS") return;
    const std::string value = card.field(1);
    if (std::strtod(value.c_str(), nullptr) == 1) return;
    left_out_->remark("PARAM,WTMASS " + value +
                      ": the deck's densities are weights, the study needs masses");
  }

  void add_solid(const NastranCard& card, const Solid& solid) {
    const auto given = static_cast<std::size_t>(
        std::count_if(card.fields.begin() + 2, card.fields.end(),
                      [](const std::string& field) { return !field.empty(); }));
    if (given != solid.corners && given != solid.nodes) {
      refuse(card, "expected " + std::to_string(solid.corners) + " or " +
                       std::to_string(solid.nodes) + " nodes, found " + std::to_string(given));
    }
    ++survey_.solids[given];
  }

  bool is_from_gmsh_;
  LeftOut* left_out_;
  FileSurvey survey_;
};

}  // namespace

FileSurvey survey_nastran(std::string_view text, LeftOut& left_out) {
  Surveyor surveyor(text.starts_with("$ Created by Gmsh"), left_out);
  for_each_nastran_card(text, [&](const NastranCard& card) { surveyor.read(card); });
  return surveyor.survey();
}

}  // namespace flexneck::mesher
