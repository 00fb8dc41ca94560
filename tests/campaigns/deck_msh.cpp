// SPDX-License-Identifier: GPL-3.0-or-later
#include <sstream>

#include "tests/campaigns/deck.h"
#include "tests/campaigns/deck_fields.h"

namespace flexneck::campaigns {

std::string write_msh(Case& drawn, const Deck& deck, const std::filesystem::path& file,
                      bool refused) {
  const Orders& orders = orders_of(deck.kind);
  std::ostringstream out;
  out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n3\n0 1 \"bottom\"\n0 2 \"top\"\n"
         "3 3 \"solid\"\n$EndPhysicalNames\n$Nodes\n"
      << deck.places.size() << "\n";
  for (const std::size_t node : shuffled(drawn, deck.places.size())) {
    out << deck.numbers[node];
    for (const double x : deck.places[node]) out << " " << printed("%.6E", x);
    out << "\n";
  }
  out << "$EndNodes\n$Elements\n"
      << deck.elements.size() + deck.bottom.size() + deck.top.size() << "\n";
  int next = 0;
  int group = 0;
  for (const auto* const nodes : {&deck.bottom, &deck.top}) {
    ++group;
    for (const std::size_t node : *nodes) {
      ++next;
      out << next << " 15 2 " << group << " " << next << " " << deck.numbers[node] << "\n";
    }
  }
  for (const std::size_t e : shuffled(drawn, deck.elements.size())) {
    out << ++next << " " << orders.gmsh_type << " 2 3 1";
    for (const std::string& node : element_fields(deck, e, orders.gmsh)) out << " " << node;
    out << "\n";
  }
  out << "$EndElements\n";
  static const std::vector<std::string> kRefused = {
      "Merge \"other.msh\";\n", "$ParametricNodes\n0\n$EndParametricNodes\n",
      "$Elements\n1\n1 15 2 9 1 999999\n$EndElements\n"};
  const std::string wrong = refused ? one_of(drawn, kRefused) : "";
  save(file, out.str() + wrong);
  return wrong;
}

}  // namespace flexneck::campaigns
