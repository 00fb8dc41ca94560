// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/exchange/inp_keywords.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace flexneck::mesher {
namespace {

constexpr std::array<std::string_view, 30> kSilent = {"AMPLITUDE",     "BUCKLE",
                                                      "CFLUX",         "CONDUCTIVITY",
                                                      "CONTACT FILE",  "CONTACT PRINT",
                                                      "CONTROLS",      "DFLUX",
                                                      "DYNAMIC",       "EL FILE",
                                                      "EL PRINT",      "ELEMENT OUTPUT",
                                                      "END STEP",      "EXPANSION",
                                                      "FREQUENCY",     "HEADING",
                                                      "MODAL DYNAMIC", "NODE FILE",
                                                      "NODE OUTPUT",   "NODE PRINT",
                                                      "OUTPUT",        "PHYSICAL CONSTANTS",
                                                      "PREPRINT",      "RESTART",
                                                      "SOLVER",        "SPECIFIC HEAT",
                                                      "STATIC",        "STEADY STATE DYNAMICS",
                                                      "STEP",          "TIME POINTS"};

constexpr std::array<std::string_view, 7> kLeftOut = {
    "CLOAD", "DAMPING", "DLOAD", "DSLOAD", "INITIAL CONDITIONS", "MODAL DAMPING", "TEMPERATURE"};

constexpr std::array<std::string_view, 6> kAssembly = {"PART",         "END PART", "ASSEMBLY",
                                                       "END ASSEMBLY", "INSTANCE", "END INSTANCE"};

template <std::size_t N>
bool is_among(const std::array<std::string_view, N>& keywords, const std::string& keyword) {
  return std::find(keywords.begin(), keywords.end(), keyword) != keywords.end();
}

}  // namespace

bool is_silent_keyword(const std::string& keyword) { return is_among(kSilent, keyword); }

bool is_left_out_keyword(const std::string& keyword) { return is_among(kLeftOut, keyword); }

bool is_assembly_keyword(const std::string& keyword) { return is_among(kAssembly, keyword); }

}  // namespace flexneck::mesher
