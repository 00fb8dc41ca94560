// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/exchange/unv_import.h"

#include <algorithm>
#include <utility>

#include "geometry/foundation/error.h"
#include "geometry/foundation/names.h"
#include "mesher/exchange/foreign_file.h"
#include "mesher/exchange/part_materials.h"
#include "mesher/exchange/unv_model.h"

namespace flexneck::mesher {
namespace {

/// Elements by their labels.
using ByLabel = std::map<std::int64_t, const UnvElement*>;

ByLabel by_label(const std::vector<UnvElement>& elements) {
  ByLabel result;
  for (const UnvElement& each : elements) result[each.element.number] = &each;
  return result;
}

/// Groups of elements by their table of material properties, as parts or surfaces.
std::vector<NumberedGroup> by_material(const ByLabel& elements, const std::string& prefix) {
  std::map<std::int64_t, std::vector<NumberedElement>> groups;
  for (const auto& [label, each] : elements) groups[each->material].push_back(each->element);
  std::vector<NumberedGroup> result;
  for (auto& [material, members] : groups) {
    result.push_back({prefix + std::to_string(material), std::move(members)});
  }
  return result;
}

NumberedGroup members_among(const UnvGroup& group, const ByLabel& elements) {
  NumberedGroup result{group.name, {}};
  for (const std::int64_t label : group.elements) {
    const auto found = elements.find(label);
    if (found != elements.end()) result.elements.push_back(found->second->element);
  }
  return result;
}

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "'" : ", '") + name + "'";
  return text;
}

class Importer {
 public:
  Importer(UnvModel model, const ImportOptions& options)
      : model_(std::move(model)),
        options_(options),
        solids_(by_label(model_.solids)),
        faces_(by_label(model_.faces)) {}

  NumberedMesh numbered() {
    mesh_.nodes = model_.mesh.nodes;
    add_parts();
    ByLabel ungrouped = faces_;
    for (const UnvGroup& group : model_.groups) {
      NumberedGroup surface = members_among(group, faces_);
      for (const NumberedElement& face : surface.elements) ungrouped.erase(face.number);
      if (!surface.elements.empty()) mesh_.surfaces.push_back(std::move(surface));
      for (const std::int64_t node : group.nodes) {
        if (mesh_.nodes.count(node) == 0) {
          throw InputError("group '" + group.name + "' has node " + std::to_string(node) +
                           ", which the file does not define");
        }
        mesh_.node_sets[group.name].insert(node);
      }
    }
    for (NumberedGroup& surface : by_material(ungrouped, "surface_")) {
      mesh_.surfaces.push_back(std::move(surface));
    }
    return std::move(mesh_);
  }

 private:
  void add_parts() {
    std::vector<NumberedGroup> of_groups;
    for (const UnvGroup& group : model_.groups) {
      NumberedGroup part = members_among(group, solids_);
      if (!part.elements.empty()) of_groups.push_back(std::move(part));
    }
    std::vector<NumberedGroup> of_materials = by_material(solids_, "volume_");
    std::vector<std::string> known = names_of(of_groups);
    for (const std::string& name : names_of(of_materials)) known.push_back(name);
    require_known_parts(known, options_.material_of_part);
    const std::vector<std::string> groups = names_of(of_groups);
    std::erase_if(of_groups, [&](const NumberedGroup& part) {
      return options_.material_of_part.count(part.name) == 0;
    });
    mesh_.parts = of_groups.empty() ? std::move(of_materials) : std::move(of_groups);
    require_one_part_per_solid(groups);
  }

  void require_one_part_per_solid(const std::vector<std::string>& groups) const {
    std::map<std::int64_t, std::string> part_of;
    for (const NumberedGroup& part : mesh_.parts) {
      for (const NumberedElement& element : part.elements) {
        const auto [entry, is_new] = part_of.emplace(element.number, part.name);
        if (is_new) continue;
        throw InputError("element " + std::to_string(element.number) + " belongs to both parts '" +
                         entry->second + "' and '" + part.name + "'");
      }
    }
    for (const auto& [label, solid] : solids_) {
      if (part_of.count(label) > 0) continue;
      throw InputError(
          std::to_string(solids_.size() - part_of.size()) +
          " elements belong to no part, the first is element " + std::to_string(label) +
          "; add groups to the parts of a material; groups with solid elements: " + listed(groups));
    }
  }

  UnvModel model_;
  const ImportOptions& options_;
  ByLabel solids_;
  ByLabel faces_;
  NumberedMesh mesh_;
};

}  // namespace

Mesh import_unv(const ImportOptions& options, const Progress& /*progress*/, LeftOut& left_out) {
  Importer importer(read_unv(checked_contents(options.file), options.length_unit_m, left_out),
                    options);
  const NumberedMesh file = importer.numbered();
  IndexedMesh indexed = indexed_mesh(file, options);
  left_out.add("nodes of no solid element", file.nodes.size() - indexed.index_of.size());
  return std::move(indexed.mesh);
}

}  // namespace flexneck::mesher
