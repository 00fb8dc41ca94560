// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/campaigns/deck_fields.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>
#include <fstream>
#include <sstream>

#include "mesher/mesh/element_kind.h"

namespace flexneck::campaigns {
namespace {

using mesher::ElementKind;

/// Node order of a format, given by corners, and midside nodes by their two corners.
std::vector<std::size_t> order_of(ElementKind kind, const std::string& text) {
  const auto nodes = mesher::reference_nodes(kind);
  std::istringstream words(text);
  std::vector<std::size_t> order;
  for (std::string word; words >> word && order.size() < nodes.size();) {
    const auto first = static_cast<std::size_t>(word.front() - '0');
    const auto last = static_cast<std::size_t>(word.back() - '0');
    std::array<double, 3> middle{};
    for (std::size_t d = 0; d < 3; ++d) middle[d] = (nodes[first][d] + nodes[last][d]) / 2;
    const auto found = std::find(nodes.begin(), nodes.end(), middle);
    if (found != nodes.end()) order.push_back(static_cast<std::size_t>(found - nodes.begin()));
  }
  return order;
}

}  // namespace

std::string printed(const char* format, double value) {
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), format, value);
  return text.data();
}

std::string coordinate(Case& drawn, double value, bool is_short) {
  const int style = is_short ? 0 : drawn.whole(0, 2);
  std::string text = printed(style == 0 ? "%.3f" : "%.6E", value);
  if (style == 2) text[text.find('E')] = 'D';
  return text;
}

std::string value_text(double value) { return printed("%.3E", value); }

std::string cased(Case& drawn, std::string text) {
  const int style = drawn.whole(0, 2);
  for (char& c : text) {
    if (style == 0) c = static_cast<char>(std::toupper(c));
    if (style == 1) c = static_cast<char>(std::tolower(c));
  }
  return text;
}

const Orders& orders_of(ElementKind kind) {
  static const Orders kHexahedron = {
      "C3D20", "0 1 2 3 4 5 6 7 01 12 23 30 45 56 67 74 04 15 26 37",
      "CHEXA", "0 1 2 3 4 5 6 7 01 12 23 30 04 15 26 37 45 56 67 74",
      "116",   "0 01 1 12 2 23 3 30 04 15 26 37 4 45 5 56 6 67 7 74",
      "17",    "0 1 2 3 4 5 6 7 01 03 04 12 15 23 26 37 45 47 56 67"};
  static const Orders kPrism = {"C3D15",  "0 1 2 3 4 5 01 12 20 34 45 53 03 14 25",
                                "CPENTA", "0 1 2 3 4 5 01 12 20 03 14 25 34 45 53",
                                "113",    "0 01 1 12 2 20 03 14 25 3 34 4 45 5 53",
                                "18",     "0 1 2 3 4 5 01 02 03 12 14 25 34 35 45"};
  static const Orders kTetrahedron = {
      "C3D10", "0 1 2 3 01 12 20 03 13 23", "CTETRA", "0 1 2 3 01 12 20 03 13 23",
      "118",   "0 01 1 12 2 20 03 13 23 3", "11",     "0 1 2 3 01 12 02 03 23 13"};
  static const Orders kHex8 = {"C3D8", "0 1 2 3 4 5 6 7", "CHEXA", "0 1 2 3 4 5 6 7",
                               "115",  "0 1 2 3 4 5 6 7", "5",     "0 1 2 3 4 5 6 7"};
  static const Orders kPrism6 = {"C3D6", "0 1 2 3 4 5", "CPENTA", "0 1 2 3 4 5",
                                 "112",  "0 1 2 3 4 5", "6",      "0 1 2 3 4 5"};
  if (kind == ElementKind::hex8) return kHex8;
  if (kind == ElementKind::prism6) return kPrism6;
  if (kind == ElementKind::prism15) return kPrism;
  return kind == ElementKind::tet10 ? kTetrahedron : kHexahedron;
}

std::vector<std::string> numbers_of(const Deck& deck, const std::vector<std::size_t>& nodes) {
  std::vector<std::string> texts;
  for (const std::size_t node : nodes) texts.push_back(std::to_string(deck.numbers[node]));
  return texts;
}

std::vector<std::string> element_fields(const Deck& deck, std::size_t element,
                                        const std::string& order) {
  std::vector<std::size_t> nodes;
  for (const std::size_t k : order_of(deck.kind, order)) nodes.push_back(deck.elements[element][k]);
  return numbers_of(deck, nodes);
}

std::vector<std::size_t> shuffled(Case& drawn, std::size_t count) {
  std::vector<std::size_t> all(count);
  for (std::size_t k = 0; k < count; ++k) all[k] = k;
  std::shuffle(all.begin(), all.end(), drawn.random);
  return all;
}

void save(const std::filesystem::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

}  // namespace flexneck::campaigns
