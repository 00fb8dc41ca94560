// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/exchange/inp_import.h"

#include <algorithm>
#include <set>

#include "geometry/foundation/error.h"
#include "geometry/foundation/names.h"
#include "mesher/exchange/abaqus_elements.h"
#include "mesher/exchange/foreign_file.h"
#include "mesher/exchange/inp_model.h"
#include "mesher/mesh/boundary.h"

namespace flexneck::mesher {
namespace {

std::vector<std::string> names_in(const InpSets& sets) {
  std::vector<std::string> names;
  names.reserve(sets.size());
  for (const auto& [key, set] : sets) names.push_back(set.name);
  return names;
}

/// The element set of this name.
/// @throws InputError with the nearest name.
const InpSet& elset_of(const InpModel& model, const std::string& name, const std::string& who) {
  const auto found = model.elsets.find(upper_case(name));
  if (found != model.elsets.end()) return found->second;
  throw InputError(who + "there is no ELSET '" + name + "'" +
                   did_you_mean(names_in(model.elsets), name));
}

struct Part {
  std::string name;
  std::string material;
};

/// The part of each element: position in `parts`, by the element's number.
struct Assignment {
  std::vector<Part> parts;
  std::map<std::int64_t, std::size_t> part_of;
};

void assign_parts_of_study(const InpModel& model, const ImportOptions& options, Assignment& all) {
  for (const auto& [part, material] : options.material_of_part) {
    const InpSet& set = elset_of(model, part, "material '" + material + "': ");
    all.parts.push_back({part, material});
    for (const std::int64_t element : set.members) {
      const auto [entry, is_new] = all.part_of.emplace(element, all.parts.size() - 1);
      if (!is_new) {
        throw InputError("element " + std::to_string(element) + " belongs to both parts '" +
                         all.parts[entry->second].name + "' and '" + part + "'");
      }
    }
  }
}

/// Assigns elements that the study does not mention to the file's sections.
void assign_parts_of_file(const InpModel& model, Assignment& all) {
  const std::size_t of_study = all.parts.size();
  for (const InpSection& section : model.sections) {
    const InpSet& set = elset_of(model, section.elset, section.place.text() + "*SOLID SECTION: ");
    const std::size_t part = all.parts.size();
    bool is_used = false;
    for (const std::int64_t element : set.members) {
      const auto [entry, is_new] = all.part_of.emplace(element, part);
      if (!is_new && entry->second >= of_study) {
        throw InputError(section.place.text() + "*SOLID SECTION: element " +
                         std::to_string(element) + " already has a section, '" +
                         all.parts[entry->second].name + "'");
      }
      is_used = is_used || is_new;
    }
    if (is_used) all.parts.push_back({set.name, section.material});
  }
}

void require_all_assigned(const InpModel& model, const Assignment& all) {
  std::size_t count = 0;
  std::int64_t first = 0;
  for (const InpElement& element : model.elements) {
    if (all.part_of.count(element.number) > 0) continue;
    if (count++ == 0) first = element.number;
  }
  if (count == 0) return;
  std::string sets;
  for (const std::string& name : names_in(model.elsets)) {
    sets += (sets.empty() ? "" : ", ") + std::string("'") + name + "'";
  }
  throw InputError(std::to_string(count) + " elements belong to no part, the first is element " +
                   std::to_string(first) +
                   "; add ELSETs to the parts of a material, or give them a *SOLID SECTION; ELSETs "
                   "of the file: " +
                   (sets.empty() ? "none" : sets));
}

/// The material in SI units: E is in F / L^2, the density in F s^2 / L^4.
Material material_in_si(const InpMaterial& given, const ImportOptions& options) {
  const auto require = [&](const std::optional<double>& value, const std::string& keyword) {
    if (!value) throw InputError("material '" + given.name + "' of the file has no " + keyword);
    return *value;
  };
  const double length = options.length_unit_m;
  return {.name = given.name,
          .youngs_modulus_Pa =
              require(given.youngs_modulus, "*ELASTIC") * options.force_unit_N / (length * length),
          .poissons_ratio = require(given.poissons_ratio, "*ELASTIC"),
          .density_kg_m3 = require(given.density, "*DENSITY") * options.force_unit_N /
                           (length * length * length * length)};
}

/// Position of a part's material in the mesh: the study's, or the file's, which is appended.
std::size_t material_index(const std::string& name, bool is_of_study, const InpModel& model,
                           const ImportOptions& options, Mesh& mesh) {
  if (is_of_study) return find_name(names_of(mesh.materials), name, "material");
  const auto found = std::find_if(
      model.materials.begin(), model.materials.end(),
      [&](const InpMaterial& each) { return upper_case(each.name) == upper_case(name); });
  if (found == model.materials.end()) {
    throw InputError("*SOLID SECTION uses the material '" + name +
                     "', which the file does not define" +
                     did_you_mean(names_of(model.materials), name));
  }
  const std::vector<std::string> known = names_of(mesh.materials);
  const auto same = std::find(known.begin(), known.end(), found->name);
  if (same != known.end()) return static_cast<std::size_t>(same - known.begin());
  mesh.materials.push_back(material_in_si(*found, options));
  return mesh.materials.size() - 1;
}

/// Nodes that elements use, numbered from 0 in the order of the file's numbers.
std::map<std::int64_t, std::int32_t> number_nodes(const InpModel& model) {
  std::map<std::int64_t, std::int32_t> index_of;
  for (const InpElement& element : model.elements) {
    for (const std::int64_t node : element.nodes) {
      if (model.nodes.count(node) == 0) {
        throw InputError("element " + std::to_string(element.number) + " has node " +
                         std::to_string(node) + ", which *NODE does not define");
      }
      index_of[node] = 0;
    }
  }
  std::int32_t next = 0;
  for (auto& [number, index] : index_of) index = next++;
  return index_of;
}

ElementBlock& block_of(Mesh& mesh, const std::string& part, ElementKind kind,
                       std::size_t material) {
  const auto found = std::find_if(
      mesh.blocks.begin(), mesh.blocks.end(),
      [&](const ElementBlock& block) { return block.part == part && block.kind == kind; });
  if (found != mesh.blocks.end()) return *found;
  return mesh.blocks.emplace_back(ElementBlock{part, kind, material, {}});
}

void add_blocks(const InpModel& model, const Assignment& all, const ImportOptions& options,
                const std::map<std::int64_t, std::int32_t>& index_of, Mesh& mesh) {
  std::vector<std::size_t> material;
  for (const Part& part : all.parts) {
    const bool is_of_study = options.material_of_part.count(part.name) > 0;
    material.push_back(material_index(part.material, is_of_study, model, options, mesh));
  }
  std::vector<std::vector<const InpElement*>> elements(all.parts.size());
  for (const InpElement& element : model.elements) {
    elements[all.part_of.at(element.number)].push_back(&element);
  }
  for (std::size_t p = 0; p < all.parts.size(); ++p) {
    if (elements[p].empty()) throw InputError("part '" + all.parts[p].name + "' has no elements");
    for (const InpElement* const element : elements[p]) {
      ElementBlock& block = block_of(mesh, all.parts[p].name, element->kind, material[p]);
      for (const std::int64_t node : element->nodes) block.nodes.push_back(index_of.at(node));
    }
  }
}

/// A node set of the file, without nodes that no element uses.
NodeSet node_set_of(const std::string& name, const std::vector<std::int64_t>& numbers,
                    const std::map<std::int64_t, std::int32_t>& index_of) {
  NodeSet set{.name = name, .nodes = {}};
  for (const std::int64_t number : numbers) {
    const auto found = index_of.find(number);
    if (found != index_of.end()) set.nodes.push_back(found->second);
  }
  return set;
}

void add_node_sets(const InpModel& model, const std::map<std::int64_t, std::int32_t>& index_of,
                   Mesh& mesh) {
  const std::vector<Facet> boundary = boundary_facets(mesh);
  const auto add = [&](NodeSet set) {
    if (set.nodes.empty()) return;  // all its nodes are without elements
    std::vector<bool> is_in(mesh.nodes.size(), false);
    for (const std::int32_t node : set.nodes) is_in[static_cast<std::size_t>(node)] = true;
    FaceSet faces = faces_among(boundary, set.name, [&](std::int32_t node) {
      return is_in[static_cast<std::size_t>(node)];
    });
    if (nodes_of(faces).nodes == set.nodes) mesh.face_sets.push_back(std::move(faces));
    mesh.node_sets.push_back(std::move(set));
  };
  for (const auto& [key, set] : model.nsets) add(node_set_of(set.name, set.members, index_of));
  if (model.nsets.count("BOUNDARY") == 0) add(node_set_of("boundary", model.fixed, index_of));
}

/// The facet S<n> of an element as a face in the node order of its kind, normal outwards.
FaceBlock face_of(const InpElement& element, std::size_t side,
                  const std::map<std::int64_t, std::int32_t>& index_of) {
  const auto abaqus = abaqus_facets(element.kind);
  if (side >= abaqus.size()) {
    throw InputError("element " + std::to_string(element.number) + " has no face S" +
                     std::to_string(side + 1));
  }
  const std::vector<std::size_t>& corners = abaqus[side];
  for (const ReferenceFacet& ours : facets_of(element.kind)) {
    const auto begin = ours.nodes.begin();
    if (!std::is_permutation(corners.begin(), corners.end(), begin,
                             begin + static_cast<std::ptrdiff_t>(corners_per_element(ours.kind)))) {
      continue;
    }
    FaceBlock face{ours.kind, {}};
    for (const std::size_t local : ours.nodes) {
      face.nodes.push_back(index_of.at(element.nodes[local]));
    }
    return face;
  }
  throw ComputationError(
      "a face of an element has no counterpart in the mesh");  // an error in the tables
}

/// Adds the SURFACEs as face sets. A surface replaces the face set made from an NSET of its name.
void add_surfaces(const InpModel& model, const std::map<std::int64_t, std::int32_t>& index_of,
                  Mesh& mesh) {
  const auto element_of = [&](std::int64_t number) -> const InpElement& {
    const auto found = std::lower_bound(
        model.elements.begin(), model.elements.end(), number,
        [](const InpElement& element, std::int64_t wanted) { return element.number < wanted; });
    if (found == model.elements.end() || found->number != number) {
      throw InputError("there is no element " + std::to_string(number));
    }
    return *found;
  };
  for (const InpSurface& surface : model.surfaces) {
    FaceSet set{.name = surface.name, .blocks = {}};
    for (const InpSide& side : surface.sides) {
      try {
        const FaceBlock face = face_of(element_of(side.element), side.side, index_of);
        const auto block =
            std::find_if(set.blocks.begin(), set.blocks.end(),
                         [&](const FaceBlock& each) { return each.kind == face.kind; });
        if (block == set.blocks.end()) {
          set.blocks.push_back(face);
        } else {
          block->nodes.insert(block->nodes.end(), face.nodes.begin(), face.nodes.end());
        }
      } catch (const InputError& error) {
        throw InputError("*SURFACE '" + surface.name + "': " + error.what());
      }
    }
    const auto is_same = [&](const auto& other) {
      return upper_case(other.name) == upper_case(surface.name);
    };
    std::erase_if(mesh.face_sets, is_same);
    const auto known = std::find_if(mesh.node_sets.begin(), mesh.node_sets.end(), is_same);
    if (known == mesh.node_sets.end()) {
      mesh.node_sets.push_back(nodes_of(set));
    } else {
      set.name = known->name;
    }
    mesh.face_sets.push_back(std::move(set));
  }
}

/// Notes element types whose integration differs from that of this program for every formulation,
/// or for all but one.
void add_integration(const InpModel& model, const ImportOptions& options, LeftOut& left_out) {
  for (const auto& [type, count] : model.types) {
    const bool is_ours = type == "C3D20R" ? options.is_reduced : type != "C3D8I" && type != "C3D8R";
    if (!is_ours)
      left_out.add("integration rules of " + type + " (determined by modes.formulation)", count);
  }
}

/// Notes the nodes that belong to no solid element.
/// @param used nodes of no solid element that the mesh keeps
void add_loose_nodes(const InpModel& model, const std::map<std::int64_t, std::int32_t>& index_of,
                     const std::set<std::int64_t>& used, LeftOut& left_out) {
  left_out.add("nodes of no solid element", model.nodes.size() - index_of.size() - used.size());
  for (const auto& [key, set] : model.nsets) {
    const auto loose =
        std::count_if(set.members.begin(), set.members.end(), [&](std::int64_t node) {
          return model.nodes.count(node) > 0 && index_of.count(node) == 0 && used.count(node) == 0;
        });
    left_out.add("of them in NSET '" + set.name + "'", static_cast<std::size_t>(loose));
  }
}

Mesh mesh_of(const InpModel& model, const ImportOptions& options, LeftOut& left_out) {
  Assignment all;
  assign_parts_of_study(model, options, all);
  assign_parts_of_file(model, all);
  require_all_assigned(model, all);
  const auto index_of = number_nodes(model);

  Mesh mesh;
  for (const auto& [number, index] : index_of) {
    std::array<double, 3> x = model.nodes.at(number);
    for (double& coordinate : x) coordinate *= options.length_unit_m;
    mesh.nodes.push_back(x);
  }
  mesh.materials = options.materials;
  add_blocks(model, all, options, index_of, mesh);
  add_node_sets(model, index_of, mesh);
  add_surfaces(model, index_of, mesh);
  const std::set<std::int64_t> used = add_connections(
      model.connections, {model.nodes, index_of, options.length_unit_m, options.force_unit_N}, mesh,
      left_out);
  add_loose_nodes(model, index_of, used, left_out);
  return mesh;
}

}  // namespace

Mesh import_inp(const ImportOptions& options, const Progress& progress, LeftOut& left_out) {
  const InpModel model = read_inp(options.file, checked_contents(options.file));
  if (progress && !model.ignored.empty()) {
    std::string keywords;
    for (const std::string& keyword : model.ignored) keywords += " *" + keyword;
    progress("ignored in " + options.file.filename().string() + ":" + keywords);
  }
  left_out = model.left_out;
  add_integration(model, options, left_out);
  return mesh_of(model, options, left_out);
}

}  // namespace flexneck::mesher
