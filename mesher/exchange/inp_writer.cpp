// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/exchange/inp_writer.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <span>

#include "geometry/foundation/ascii.h"
#include "geometry/foundation/error.h"
#include "geometry/foundation/names.h"
#include "geometry/foundation/output_file.h"
#include "mesher/exchange/abaqus_elements.h"
#include "mesher/exchange/edge_order.h"
#include "mesher/exchange/inp_cards.h"
#include "mesher/mesh/facet_key.h"

namespace flexneck::mesher {
namespace {

constexpr int kNumberWidth = 20;  ///< CalculiX truncates longer numbers
constexpr std::size_t kFieldsPerLine = 16;

std::string number(double value) { return text_within(value, kNumberWidth); }

void check_inp_names(const std::vector<std::string>& names, const std::string& kind) {
  std::set<std::string> seen;
  for (const std::string& name : names) {
    const bool is_plain = is_letter(name.front()) && name.size() <= 80 &&
                          std::all_of(name.begin(), name.end(), [](char c) {
                            return is_letter_or_digit(c) || c == '_' || c == '-' || c == '.';
                          });
    if (!is_plain) {
      throw InputError("an .inp file cannot contain the " + kind + " '" + name +
                       "'; expected at most 80 letters, digits, _, - and ., the first a letter");
    }
    if (!seen.insert(upper_case(name)).second) {
      throw InputError("an .inp file does not distinguish the " + kind + " '" + name +
                       "' from another one that differs only in case");
    }
  }
}

/// Writes whole numbers, sixteen a line; a comma at the end of a line announces more.
void write_list(OutputFile& out, std::span<const std::int64_t> values) {
  std::string text;
  for (std::size_t i = 0; i < values.size(); ++i) {
    text += std::to_string(values[i]);
    const bool is_last = i + 1 == values.size();
    if (!is_last) text += ",";
    if (is_last || (i + 1) % kFieldsPerLine == 0) text += "\n";
  }
  out.write(text);
}

void write_nodes(OutputFile& out, const Mesh& mesh) {
  out.write("*NODE\n");
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
    const auto& x = mesh.nodes[n];
    out.write(std::to_string(n + 1) + "," + number(x[0]) + "," + number(x[1]) + "," + number(x[2]) +
              "\n");
  }
}

std::string type_of(const Mesh& mesh, const ElementBlock& block, const InpOptions& options) {
  return abaqus_type_of(block.kind, options.reduced.count(mesh.materials[block.material].name) > 0);
}

void write_elements(OutputFile& out, const Mesh& mesh, const InpOptions& options) {
  std::int64_t next = 0;
  for (const ElementBlock& block : mesh.blocks) {
    out.write("*ELEMENT,TYPE=" + type_of(mesh, block, options) + ",ELSET=" + block.part + "\n");
    const std::vector<std::size_t> order = edge_order(block.kind);
    for (std::size_t first = 0; first < block.nodes.size(); first += order.size()) {
      std::vector<std::int64_t> row = {++next};
      for (const std::size_t local : order) row.push_back(block.nodes[first + local] + 1);
      write_list(out, row);
    }
  }
}

void write_node_sets(OutputFile& out, const Mesh& mesh) {
  for (const NodeSet& set : mesh.node_sets) {
    out.write("*NSET,NSET=" + set.name + "\n");
    std::vector<std::int64_t> numbers;
    for (const std::int32_t node : set.nodes) numbers.push_back(node + 1);
    write_list(out, numbers);
  }
}

/// "<element>,S<n>" of the first element that has a facet, by the facet's key.
using SideNames = std::map<FacetKey, std::string>;

SideNames side_names(const Mesh& mesh) {
  SideNames names;
  std::size_t next = 0;
  for (const ElementBlock& block : mesh.blocks) {
    const std::size_t n = nodes_per_element(block.kind);
    const auto sides = abaqus_facets(block.kind);
    for (std::size_t first = 0; first < block.nodes.size(); first += n) {
      ++next;
      for (std::size_t s = 0; s < sides.size(); ++s) {
        std::vector<std::int32_t> corners;
        for (const std::size_t local : sides[s]) corners.push_back(block.nodes[first + local]);
        names.emplace(key_of_corners(corners),
                      std::to_string(next) + ",S" + std::to_string(s + 1) + "\n");
      }
    }
  }
  return names;
}

void write_surfaces(OutputFile& out, const Mesh& mesh) {
  if (mesh.face_sets.empty()) return;
  const SideNames names = side_names(mesh);
  for (const FaceSet& set : mesh.face_sets) {
    out.write("*SURFACE,NAME=" + set.name + ",TYPE=ELEMENT\n");
    for (const FaceBlock& block : set.blocks) {
      const std::size_t n = nodes_per_element(block.kind);
      for (std::size_t first = 0; first < block.nodes.size(); first += n) {
        const auto nodes = std::span(block.nodes).subspan(first, n);
        const auto found = names.find(key_of_face(block.kind, nodes));
        if (found == names.end()) {
          throw InputError("a face of set '" + set.name + "' belongs to no element");
        }
        out.write(found->second);
      }
    }
  }
}

void write_materials(OutputFile& out, const Mesh& mesh) {
  for (const Material& material : mesh.materials) {
    out.write("*MATERIAL,NAME=" + material.name + "\n*ELASTIC\n" +
              number(material.youngs_modulus_Pa) + "," + number(material.poissons_ratio) +
              "\n*DENSITY\n" + number(material.density_kg_m3) + "\n");
  }
  for (const std::string& part : parts_of(mesh)) {
    const auto block = std::find_if(mesh.blocks.begin(), mesh.blocks.end(),
                                    [&](const ElementBlock& each) { return each.part == part; });
    out.write("*SOLID SECTION,ELSET=" + part + ",MATERIAL=" + mesh.materials[block->material].name +
              "\n");
  }
}

using FixedNodes = std::map<std::int32_t, std::array<bool, 3>>;

/// Writes tied slits as equations. The upper node of a pair follows the lower one, unless both are
/// fixed.
void write_ties(OutputFile& out, const Mesh& mesh, const FixedNodes& fixed) {
  for (const Slit& slit : mesh.slits) {
    if (!slit.tied) continue;
    for (std::size_t p = 0; p < slit.lower.size(); ++p) {
      const auto found = fixed.find(slit.upper[p]);
      const std::string upper = std::to_string(slit.upper[p] + 1);
      const std::string lower = std::to_string(slit.lower[p] + 1);
      for (std::size_t a = 0; a < 3; ++a) {
        if (found != fixed.end() && found->second[a]) continue;
        const std::string direction = std::to_string(a + 1);
        out.write("*EQUATION\n2\n" + upper + "," + direction + ",1.," + lower + "," + direction +
                  ",-1.\n");
      }
    }
  }
}

void write_boundary(OutputFile& out, const Mesh& mesh, const InpOptions& options) {
  const std::vector<Support>& supports = mesh.connections.supports;
  if (options.fixed.empty() && options.fixed_directions.empty() && supports.empty()) return;
  out.write("*BOUNDARY\n");
  for (const Support& support : supports) {
    for (const std::int32_t node : support.nodes) {
      for (std::size_t a = 0; a < 3; ++a) {
        if (!support.directions[a]) continue;
        out.write(std::to_string(node + 1) + "," + std::to_string(a + 1) + "\n");
      }
    }
  }
  for (const std::string& name : options.fixed) out.write(name + ",1,3\n");
  for (const auto& [name, directions] : options.fixed_directions) {
    for (std::size_t a = 0; a < 3; ++a) {
      if (directions[a]) out.write(name + "," + std::to_string(a + 1) + "\n");
    }
  }
}

/// Refuses connections other than supports along x, y and z.
void check_connections(Connections connections) {
  std::erase_if(connections.supports,
                [](const Support& support) { return support.axes.is_global(); });
  if (connections.empty()) return;
  throw InputError(
      "an .inp file cannot be written with " + connections.text() +
      "; of connections, only supports along x, y and z are supported; remove the others");
}

/// Writes "node,direction[,direction],value" for the values that are not zero.
void write_values(OutputFile& out, const std::string& card, bool twice,
                  const std::vector<std::array<double, 3>>& values) {
  bool has_begun = false;
  for (std::size_t n = 0; n < values.size(); ++n) {
    for (std::size_t a = 0; a < 3; ++a) {
      if (values[n][a] == 0) continue;
      if (!has_begun) out.write(card + "\n");
      has_begun = true;
      const std::string direction = "," + std::to_string(a + 1);
      out.write(std::to_string(n + 1) + direction + (twice ? direction : "") + "," +
                number(values[n][a]) + "\n");
    }
  }
}

void write_steps(OutputFile& out, const InpOptions& options) {
  const bool is_loaded = options.static_step.has_value();
  if (is_loaded) {
    out.write("*STEP\n*STATIC\n");
    write_values(out, "*BOUNDARY", true, options.static_step->displacements_m);
    write_values(out, "*CLOAD", false, options.static_step->forces_N);
    out.write("*NODE FILE\nU,RF\n*EL FILE\nS\n*END STEP\n");
  }
  out.write(is_loaded && options.static_step->prestresses_modes ? "*STEP,PERTURBATION\n"
                                                                : "*STEP\n");
  out.write("*FREQUENCY\n" + std::to_string(options.mode_count) + "\n*END STEP\n");
}

FixedNodes fixed_nodes(const Mesh& mesh, const InpOptions& options) {
  FixedNodes nodes;
  const auto fix = [&](const std::string& name, const std::array<bool, 3>& directions) {
    for (const std::int32_t node : mesh.node_set(name).nodes) {
      for (std::size_t a = 0; a < 3; ++a) nodes[node][a] = nodes[node][a] || directions[a];
    }
  };
  for (const std::string& name : options.fixed) fix(name, {true, true, true});
  for (const auto& [name, directions] : options.fixed_directions) fix(name, directions);
  for (const Support& support : mesh.connections.supports) {
    for (const std::int32_t node : support.nodes) {
      for (std::size_t a = 0; a < 3; ++a) nodes[node][a] = nodes[node][a] || support.directions[a];
    }
  }
  return nodes;
}

}  // namespace

void write_inp(const std::filesystem::path& file, const Mesh& mesh, const InpOptions& options) {
  check_inp_names(parts_of(mesh), "part");
  check_inp_names(names_of(mesh.node_sets), "node set");
  check_inp_names(names_of(mesh.face_sets), "face set");
  check_inp_names(names_of(mesh.materials), "material");
  for (const ElementBlock& block : mesh.blocks) {
    static_cast<void>(type_of(mesh, block, options));
  }
  check_connections(mesh.connections);
  const FixedNodes fixed = fixed_nodes(mesh, options);

  OutputFile out(file);
  out.write("*HEADING\nflexneck: lengths in m, forces in N, stresses in Pa, densities in kg/m^3\n");
  write_nodes(out, mesh);
  write_elements(out, mesh, options);
  write_node_sets(out, mesh);
  write_surfaces(out, mesh);
  write_materials(out, mesh);
  write_ties(out, mesh, fixed);
  write_boundary(out, mesh, options);
  write_steps(out, options);
  out.commit();
}

}  // namespace flexneck::mesher
