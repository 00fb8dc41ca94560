// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/exchange/inp_keywords.h"

#include <algorithm>

#include "geometry/foundation/names.h"

namespace flexneck::mesher {
namespace {

InpParameter obeyed(std::string name, std::vector<std::string> values = {}) {
  return {std::move(name), std::move(values), {}};
}
InpParameter flag(std::string name) { return {std::move(name), {""}, {}}; }
InpParameter without_effect(std::string name, std::string reason) {
  return {std::move(name), {}, std::move(reason)};
}

std::map<std::string, InpKeyword> keywords_that_are_read() {
  const InpParameter internal =
      without_effect("INTERNAL", "Abaqus/CAE hides the set or surface from its lists");
  const InpParameter unsorted =
      without_effect("UNSORTED",
                     "only equations and constraints between sets use the order, and "
                     "they are refused");
  const std::string held = "a displacement of zero is zero at all times";
  std::map<std::string, InpKeyword> rows;
  const auto add = [&](const std::string& keyword, std::vector<InpParameter> parameters) {
    rows[keyword] = {InpUse::read, std::move(parameters), {}};
  };
  add("NODE", {obeyed("NSET"), obeyed("SYSTEM", {"R"})});
  add("ELEMENT", {obeyed("TYPE"), obeyed("ELSET")});
  add("ELSET", {obeyed("ELSET"), flag("GENERATE"), internal, unsorted});
  add("NSET", {obeyed("NSET"), flag("GENERATE"), internal, unsorted});
  add("SURFACE", {obeyed("NAME"), obeyed("TYPE", {"ELEMENT"}), internal});
  add("MATERIAL", {obeyed("NAME")});
  add("ELASTIC", {obeyed("TYPE", {"ISO", "ISOTROPIC"}),
                  without_effect("MODULI",
                                 "both are the same without *VISCOELASTIC, which is "
                                 "refused")});
  add("DENSITY", {});
  add("SOLID SECTION", {obeyed("ELSET"), obeyed("MATERIAL")});
  add("BOUNDARY",
      {obeyed("TYPE", {"DISPLACEMENT"}), obeyed("OP", {"MOD", "NEW"}),
       without_effect("AMPLITUDE", held), without_effect("TIME DELAY", held),
       without_effect("FIXED", "modes are motions about the place where a node is held")});
  add("EQUATION", {});
  add("MPC", {});
  add("RIGID BODY",
      {obeyed("NSET"), obeyed("ELSET"), obeyed("REF NODE"), obeyed("ROT NODE"),
       obeyed("POSITION", {"INPUT"}), without_effect("ISOTHERMAL", "a mesh has no temperatures")});
  add("TRANSFORM", {obeyed("NSET"), obeyed("TYPE", {"R", "C"})});
  add("MASS", {obeyed("ELSET"), obeyed("TYPE", {"ISOTROPIC"})});
  add("SPRING", {obeyed("ELSET")});
  return rows;
}

void add_keywords_without_effect(std::map<std::string, InpKeyword>& rows) {
  const auto add = [&](InpUse use, const std::string& reason,
                       std::initializer_list<const char*> keywords) {
    for (const char* const keyword : keywords) rows[keyword] = {use, {}, reason};
  };
  add(InpUse::passed_over, "they say what is printed or written",
      {"CONTACT FILE", "CONTACT PRINT", "EL FILE", "EL PRINT", "ELEMENT OUTPUT", "HEADING",
       "NODE FILE", "NODE OUTPUT", "NODE PRINT", "OUTPUT", "PREPRINT", "TIME POINTS"});
  add(InpUse::passed_over, "the study, not the deck, says what is computed and how",
      {"BUCKLE", "CONTROLS", "DYNAMIC", "END STEP", "FREQUENCY", "MODAL DYNAMIC", "SOLVER",
       "STATIC", "STEADY STATE DYNAMICS", "STEP"});
  add(InpUse::passed_over, "only loads and temperatures, which are left out, have it",
      {"AMPLITUDE", "CFLUX", "CONDUCTIVITY", "DFLUX", "EXPANSION", "PHYSICAL CONSTANTS",
       "SPECIFIC HEAT"});
  add(InpUse::left_out, "the whole keyword is left out, and told",
      {"CLOAD", "DAMPING", "DLOAD", "DSLOAD", "INITIAL CONDITIONS", "MODAL DAMPING",
       "TEMPERATURE"});
  add(InpUse::assembly, "the whole keyword is refused",
      {"PART", "END PART", "ASSEMBLY", "END ASSEMBLY", "INSTANCE", "END INSTANCE"});
  // READ continues from the model and the state of another analysis.
  const std::string written = "the file that it writes is for another run";
  rows["RESTART"] = {
      InpUse::passed_over,
      {without_effect("WRITE", written), without_effect("FREQUENCY", written),
       without_effect("OVERLAY", written), without_effect("NUMBER INTERVAL", written),
       without_effect("TIME MARKS", written)},
      {}};
}

std::string listed(const std::vector<std::string>& texts) {
  std::string list;
  for (const std::string& text : texts) list += (list.empty() ? "" : " or ") + text;
  return list;
}

}  // namespace

const std::map<std::string, InpKeyword>& inp_keywords() {
  static const std::map<std::string, InpKeyword> kKeywords = [] {
    auto rows = keywords_that_are_read();
    add_keywords_without_effect(rows);
    return rows;
  }();
  return kKeywords;
}

void check_parameters(const InpCard& card, const InpKeyword& keyword) {
  for (const auto& parameter : card.parameters) {
    const std::string& name = parameter.first;
    const std::string& value = parameter.second;
    const auto row = std::find_if(keyword.parameters.begin(), keyword.parameters.end(),
                                  [&](const InpParameter& each) { return each.name == name; });
    if (row == keyword.parameters.end()) {
      if (!keyword.others.empty()) continue;
      std::vector<std::string> known;
      for (const InpParameter& each : keyword.parameters) known.push_back(each.name);
      card.refuse("the parameter " + name +
                  " is not supported and may change the structure; remove it" +
                  did_you_mean(known, name));
    }
    const auto& values = row->values;
    if (values.empty() ||
        std::find(values.begin(), values.end(), upper_case(value)) != values.end())
      continue;
    card.refuse(values.front().empty()
                    ? name + " takes no value, found " + name + "=" + value
                    : "expected " + name + "=" + listed(values) + ", found " + name + "=" + value);
  }
}

}  // namespace flexneck::mesher
