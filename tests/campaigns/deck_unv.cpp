// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <utility>

#include "tests/campaigns/deck.h"
#include "tests/campaigns/deck_fields.h"

namespace flexneck::campaigns {

std::string write_unv(Case& drawn, const Deck& deck, const std::filesystem::path& file,
                      bool refused) {
  const Orders& orders = orders_of(deck.kind);
  const auto join = [](const std::vector<std::string>& words) {
    std::string line;
    for (const std::string& word : words) line += "  " + word;
    return line + "\n";
  };
  std::string text = "    -1\n  2411\n";
  for (const std::size_t node : shuffled(drawn, deck.places.size())) {
    const Eigen::Vector3d& x = deck.places[node];
    text += "  " + std::to_string(deck.numbers[node]) + "  1  1  11\n" +
            join({coordinate(drawn, x[0], false), coordinate(drawn, x[1], false),
                  coordinate(drawn, x[2], false)});
  }
  text += "    -1\n    -1\n  2412\n";
  for (const std::size_t e : shuffled(drawn, deck.elements.size())) {
    const std::vector<std::string> nodes = element_fields(deck, e, orders.unv);
    text += join({std::to_string(deck.element_numbers[e]), orders.unv_type, "1", "1", "7",
                  std::to_string(nodes.size())});
    for (std::size_t k = 0; k < nodes.size(); k += 8)
      text += join({nodes.begin() + static_cast<std::ptrdiff_t>(k),
                    nodes.begin() + static_cast<std::ptrdiff_t>(std::min(k + 8, nodes.size()))});
  }
  static const std::vector<std::string> kGroups = {"2435", "2452", "2467", "2477"};
  text += "    -1\n    -1\n  " + one_of(drawn, kGroups) + "\n";
  for (const auto& [name, nodes] : {std::pair("bottom", deck.bottom), std::pair("top", deck.top)}) {
    text += "  1  0  0  0  0  0  0  " + std::to_string(nodes.size()) + "\n" + name + "\n";
    for (std::size_t k = 0; k < nodes.size(); ++k)
      text += "  7  " + std::to_string(deck.numbers[nodes[k]]) + "  0  0" +
              (k % 2 == 1 || k + 1 == nodes.size() ? "\n" : "");
  }
  text += "    -1\n";
  static const std::vector<std::string> kRefused = {
      "    -1\n  2412\n  900001  117  1  1  7  2\n  1  2\n    -1\n",
      "    -1\n  2467\n  1  0  0  0  0  0  0  1\nlost\n  7  999999  0  0\n    -1\n",
      "    -1\n  2411\n  900001  1  1  11\n  1.0  2.0\n    -1\n", "    -1\n  2411\n"};
  const std::string wrong = refused ? one_of(drawn, kRefused) : "";
  save(file, text + wrong);
  return wrong;
}

}  // namespace flexneck::campaigns
