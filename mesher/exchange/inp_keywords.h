// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <string>
#include <vector>

#include "mesher/exchange/inp_cards.h"

namespace flexneck::mesher {

enum class InpUse {
  read,         ///< nodes, elements, sets, materials, connections
  passed_over,  ///< output requests, the control of an analysis, properties of other analyses
  left_out,  ///< loads, prestress and damping, which a mesh cannot hold: reported with their number
  assembly   ///< parts, instances and assembly: refused with advice
};

/// A parameter of a keyword line that is accepted.
struct InpParameter {
  std::string name;
  std::vector<std::string> values;  ///< in capitals; empty: any. A flag has the one value "".
  std::string no_effect;            ///< reason why it changes nothing; empty: it is obeyed
};

struct InpKeyword {
  InpUse use = InpUse::read;
  std::vector<InpParameter> parameters;
  std::string others;  ///< reason why all other parameters change nothing; empty: refused
};

/// All known keywords, in capitals; unknown ones may change the structure.
const std::map<std::string, InpKeyword>& inp_keywords();

/// Checks the parameters of a card.
/// @throws InputError naming a parameter that the keyword's row does not accept.
void check_parameters(const InpCard& card, const InpKeyword& keyword);

}  // namespace flexneck::mesher
