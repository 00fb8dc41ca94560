// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/exchange/unv_model.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <set>

#include "geometry/foundation/error.h"
#include "geometry/foundation/output_file.h"
#include "mesher/exchange/edge_order.h"
#include "mesher/exchange/text_lines.h"

namespace flexneck::mesher {
namespace {

/// Data sets that add nothing to the structure by themselves: headers, coordinate systems,
/// materials, results.
constexpr std::array<int, 18> kSilent = {15,   18,   55,   56,   57,   58,   151, 156, 1705,
                                         1710, 2400, 2414, 2420, 2437, 2448, 772, 789, 2438};
/// Tables of properties: the thickness of shells, the section of beams.
constexpr std::array<int, 3> kProperties = {772, 2437, 2448};
constexpr std::array<int, 4> kGroups = {2435, 2452, 2467, 2477};

template <std::size_t N>
bool is_among(const std::array<int, N>& numbers, int number) {
  return std::find(numbers.begin(), numbers.end(), number) != numbers.end();
}

/// Classifies elements by their FE descriptor, the number of I-deas' kind of element.
bool is_beam(int descriptor) { return descriptor < 40; }
bool is_shell(int descriptor) { return descriptor > 40 && descriptor < 100; }
bool is_solid(int descriptor) {
  return (descriptor > 100 && descriptor < 120) || descriptor == 312 || descriptor == 313;
}

/// The element kind of a descriptor. Plane stress, plane strain, plate, membrane, axisymmetric
/// solid and thin shell number their linear and parabolic triangles and quadrilaterals alike. 312
/// and 313 are Salome's pyramids.
std::optional<ElementKind> kind_of(int descriptor) {
  switch (descriptor) {
    case 111:
      return ElementKind::tet4;
    case 112:
      return ElementKind::prism6;
    case 113:
      return ElementKind::prism15;
    case 115:
      return ElementKind::hex8;
    case 116:
      return ElementKind::hex20;
    case 118:
      return ElementKind::tet10;
    case 312:
      return ElementKind::pyramid5;
    case 313:
      return ElementKind::pyramid13;
    case 41:
    case 51:
    case 61:
    case 74:
    case 81:
    case 91:
      return ElementKind::tri3;
    case 42:
    case 52:
    case 62:
    case 72:
    case 82:
    case 92:
      return ElementKind::tri6;
    case 44:
    case 54:
    case 64:
    case 71:
    case 84:
    case 94:
      return ElementKind::quad4;
    case 45:
    case 55:
    case 65:
    case 75:
    case 85:
    case 95:
      return ElementKind::quad8;
    default:
      return std::nullopt;
  }
}

/// Node order. Parabolic elements list the lower face, where corners and edges alternate, then the
/// edges to the upper face, then the upper face. Entry k is the local node at position k.
std::vector<std::size_t> round_order(ElementKind kind) {
  const std::vector<std::size_t> edges = edge_order(kind);
  if (order_of(kind) == 1) return edges;
  const std::size_t corners = corners_per_element(kind);
  const ReferenceShape shape = shape_of(kind);
  const bool has_two_faces = shape == ReferenceShape::hexahedron || shape == ReferenceShape::prism;
  const bool has_apex = shape == ReferenceShape::tetrahedron || shape == ReferenceShape::pyramid;
  const std::size_t round = has_two_faces ? corners / 2 : has_apex ? corners - 1 : corners;
  std::vector<std::size_t> order;
  const auto add_face = [&](std::size_t corner, std::size_t edge) {
    for (std::size_t k = 0; k < round; ++k) {
      order.push_back(edges[corner + k]);
      order.push_back(edges[edge + k]);
    }
  };
  add_face(0, corners);
  const std::size_t rising = corners + (has_two_faces ? 2 : 1) * round;
  for (std::size_t k = rising; k < edges.size(); ++k) order.push_back(edges[k]);
  if (has_two_faces) add_face(round, corners + round);
  if (has_apex) order.push_back(edges[round]);
  return order;
}

/// A line of a data set, with its number in the file for messages.
struct Line {
  std::string_view text;
  std::size_t number = 0;

  [[noreturn]] void refuse(const std::string& problem) const {
    throw InputError("line " + std::to_string(number) + ": " + problem);
  }
};
using Lines = std::vector<Line>;

/// Numbers separated by blanks; exponents may be written with a D.
template <class Number>
std::vector<Number> numbers_in(const Line& line) {
  std::string text(line.text);
  std::replace(text.begin(), text.end(), 'D', 'E');
  std::vector<Number> numbers;
  const char* at = text.data();
  const char* const end = at + text.size();
  while (true) {
    while (at != end && (*at == ' ' || *at == '\t')) ++at;
    if (at == end) return numbers;
    if (*at == '+') ++at;
    Number number{};
    const auto [next, error] = std::from_chars(at, end, number);
    if (error != std::errc() || (next != end && *next != ' ' && *next != '\t')) {
      line.refuse("expected numbers separated by blanks, found '" +
                  std::string(trimmed(line.text).substr(0, 40)) + "'");
    }
    numbers.push_back(number);
    at = next;
  }
}

class Reader {
 public:
  Reader(double length_unit_m, LeftOut& left_out)
      : length_unit_m_(length_unit_m), left_out_(left_out) {}

  void read(int data_set, const Lines& lines) {
    has_properties_ = has_properties_ || is_among(kProperties, data_set);
    if (data_set == 2411) {
      add_nodes(lines);
    } else if (data_set == 2412) {
      add_elements(lines);
    } else if (data_set == 164) {
      compare_units(lines);
    } else if (is_among(kGroups, data_set)) {
      add_groups(lines);
    } else if (!is_among(kSilent, data_set)) {
      left_out_.add("data set " + std::to_string(data_set));
    }
  }

  UnvModel finish() {
    if (has_properties_) {
      left_out_.add("shells", model_.faces.size());
      left_out_.add("beams and rods", beams_);
    }
    return std::move(model_);
  }

 private:
  /// Reads nodes. Each has a line with label, two coordinate systems and colour, and one with the
  /// position.
  void add_nodes(const Lines& lines) {
    for (std::size_t l = 0; l < lines.size(); l += 2) {
      const std::vector<std::int64_t> head = numbers_in<std::int64_t>(lines[l]);
      if (head.empty() || l + 1 == lines.size()) lines[l].refuse("expected two lines per node");
      const std::vector<double> x = numbers_in<double>(lines[l + 1]);
      if (x.size() != 3) lines[l + 1].refuse("expected three coordinates");
      try {
        model_.mesh.add_node(head[0], {x[0], x[1], x[2]});
      } catch (const InputError& error) {
        lines[l].refuse(error.what());
      }
    }
  }

  /// Reads elements. Each has a line with label, descriptor, tables of physical and of material
  /// properties, colour and number of nodes; for beams a line with their sections; then the nodes,
  /// eight a line.
  void add_elements(const Lines& lines) {
    for (std::size_t l = 0; l < lines.size();) {
      const Line& first = lines[l];
      const std::vector<std::int64_t> head = numbers_in<std::int64_t>(first);
      if (head.size() < 6 || head[5] < 1) {
        first.refuse("expected an element's label, descriptor, properties and number of nodes");
      }
      const auto descriptor = static_cast<int>(head[1]);
      const auto count = static_cast<std::size_t>(head[5]);
      l += is_beam(descriptor) ? 2 : 1;
      std::vector<std::int64_t> nodes;
      for (; l < lines.size() && nodes.size() < count; ++l) {
        const std::vector<std::int64_t> more = numbers_in<std::int64_t>(lines[l]);
        nodes.insert(nodes.end(), more.begin(), more.end());
      }
      if (nodes.size() != count) {
        first.refuse("expected " + std::to_string(count) + " nodes, found " +
                     std::to_string(nodes.size()));
      }
      if (!labels_.insert(head[0]).second) {
        first.refuse("element " + std::to_string(head[0]) + " is defined twice");
      }
      add_element(first, {{head[0], {}, nodes}, head[3]}, descriptor);
    }
  }

  void add_element(const Line& line, UnvElement given, int descriptor) {
    const std::optional<ElementKind> kind = kind_of(descriptor);
    if (is_beam(descriptor)) {
      ++beams_;
    } else if (!kind && (is_solid(descriptor) || is_shell(descriptor))) {
      line.refuse("elements of descriptor " + std::to_string(descriptor) + " are not supported");
    } else if (!kind) {
      left_out_.add("elements of descriptor " + std::to_string(descriptor));
    } else {
      const std::vector<std::size_t> order = round_order(*kind);
      const std::vector<std::int64_t> nodes = given.element.nodes;
      if (nodes.size() != order.size()) {
        line.refuse("expected " + std::to_string(order.size()) + " nodes of descriptor " +
                    std::to_string(descriptor) + ", found " + std::to_string(nodes.size()));
      }
      given.element.kind = *kind;
      for (std::size_t k = 0; k < order.size(); ++k) given.element.nodes[order[k]] = nodes[k];
      (is_solid(descriptor) ? model_.solids : model_.faces).push_back(std::move(given));
    }
  }

  /// Reads groups. Each has a line of eight numbers, the last one the number of members; a line
  /// with the name; the members, two a line: kind (7 a node, 8 an element), label and two numbers
  /// that are not needed.
  void add_groups(const Lines& lines) {
    for (std::size_t l = 0; l < lines.size();) {
      const Line& first = lines[l];
      const std::vector<std::int64_t> head = numbers_in<std::int64_t>(first);
      if (head.size() < 8 || head[7] < 0 || l + 1 == lines.size()) {
        first.refuse("expected a group's eight numbers and its name");
      }
      UnvGroup& group = group_of(std::string(trimmed(lines[l + 1].text)));
      l += 2;
      std::vector<std::int64_t> members;
      for (; l < lines.size() && members.size() < 4 * static_cast<std::size_t>(head[7]); ++l) {
        const std::vector<std::int64_t> more = numbers_in<std::int64_t>(lines[l]);
        members.insert(members.end(), more.begin(), more.end());
      }
      if (members.size() != 4 * static_cast<std::size_t>(head[7])) {
        first.refuse("group '" + group.name + "': expected " + std::to_string(head[7]) +
                     " members of four numbers each, found " + std::to_string(members.size()) +
                     " numbers");
      }
      for (std::size_t m = 0; m < members.size(); m += 4) {
        if (members[m] == 7) {
          group.nodes.push_back(members[m + 1]);
        } else if (members[m] == 8) {
          group.elements.push_back(members[m + 1]);
        } else {
          left_out_.add("members of groups that are neither nodes nor elements");
        }
      }
    }
  }

  UnvGroup& group_of(const std::string& name) {
    const auto known = std::find_if(model_.groups.begin(), model_.groups.end(),
                                    [&](const UnvGroup& group) { return group.name == name; });
    if (known != model_.groups.end()) return *known;
    return model_.groups.emplace_back(UnvGroup{name, {}, {}});
  }

  /// Compares the unit of length. The second line begins with the number of the file's units in a
  /// metre.
  void compare_units(const Lines& lines) {
    if (lines.size() < 2) return;
    const std::vector<double> factors = numbers_in<double>(lines[1]);
    if (factors.empty() || std::abs(factors[0] * length_unit_m_ - 1) < 1e-3) return;
    left_out_.remark("data set 164 gives " + rounded_text(factors[0], 4) +
                     " length units per metre, but the unit of the study is " +
                     rounded_text(1 / length_unit_m_, 4));
  }

  double length_unit_m_;
  LeftOut& left_out_;
  UnvModel model_;
  std::set<std::int64_t> labels_;
  bool has_properties_ = false;
  std::size_t beams_ = 0;
};

bool is_delimiter(std::string_view line) { return trimmed(line) == "-1"; }

}  // namespace

UnvModel read_unv(std::string_view text, double length_unit_m, LeftOut& left_out) {
  Reader reader(length_unit_m, left_out);
  TextLines lines(text);
  while (auto line = lines.next()) {
    if (!is_delimiter(*line)) continue;
    line = lines.next();
    if (!line) break;
    const Line head{*line, lines.number()};
    const std::vector<int> number = numbers_in<int>(head);
    if (number.empty()) head.refuse("expected the number of a data set");
    Lines body;
    while ((line = lines.next()) && !is_delimiter(*line)) body.push_back({*line, lines.number()});
    if (!line) head.refuse("data set " + std::to_string(number[0]) + " has no end");
    reader.read(number[0], body);
  }
  return reader.finish();
}

}  // namespace flexneck::mesher
