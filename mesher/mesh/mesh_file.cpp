// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/mesh/mesh_file.h"

#include <algorithm>
#include <map>
#include <utility>

#include "geometry/foundation/error.h"

namespace flexneck::mesher {
namespace {

/// Members of a group come back in alphabetical order; this attribute keeps the mesh's own.
const std::string kIndex = "index";

void write_nodes(Hdf5Writer& file, const Mesh& mesh) {
  std::vector<double> values;
  values.reserve(3 * mesh.nodes.size());
  for (const auto& node : mesh.nodes) values.insert(values.end(), node.begin(), node.end());
  file.write("/nodes", values, {mesh.nodes.size(), 3}, "m");
}

void write_materials(Hdf5Writer& file, const Mesh& mesh) {
  for (std::size_t m = 0; m < mesh.materials.size(); ++m) {
    const Material& material = mesh.materials[m];
    const std::string group = "/materials/" + material.name;
    file.write_attribute(group, kIndex, static_cast<std::int64_t>(m));
    file.write_attribute(group, "youngs_modulus_Pa", material.youngs_modulus_Pa);
    file.write_attribute(group, "poissons_ratio", material.poissons_ratio);
    file.write_attribute(group, "density_kg_m3", material.density_kg_m3);
  }
}

void write_blocks(Hdf5Writer& file, const Mesh& mesh) {
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b) {
    const ElementBlock& block = mesh.blocks[b];
    const std::string group = "/blocks/" + block.part;
    file.write(group + "/connectivity", block.nodes, {block.size(), nodes_per_element(block.kind)});
    file.write_attribute(group, kIndex, static_cast<std::int64_t>(b));
    file.write_attribute(group, "kind", name_of(block.kind));
    file.write_attribute(group, "material", mesh.materials[block.material].name);
  }
}

void write_sets(Hdf5Writer& file, const Mesh& mesh) {
  for (std::size_t s = 0; s < mesh.node_sets.size(); ++s) {
    const NodeSet& set = mesh.node_sets[s];
    const std::string dataset = "/node_sets/" + set.name;
    file.write(dataset, set.nodes, {set.nodes.size()});
    file.write_attribute(dataset, kIndex, static_cast<std::int64_t>(s));
  }
  for (std::size_t s = 0; s < mesh.face_sets.size(); ++s) {
    const FaceSet& set = mesh.face_sets[s];
    const std::size_t n = nodes_per_element(set.kind);
    const std::string dataset = "/face_sets/" + set.name;
    file.write(dataset, set.nodes, {set.nodes.size() / n, n});
    file.write_attribute(dataset, kIndex, static_cast<std::int64_t>(s));
    file.write_attribute(dataset, "kind", name_of(set.kind));
  }
}

/// Paths of a group's members, ordered by their attribute `index`, which counts from 0.
std::vector<std::string> ordered_members(const Hdf5Reader& file, const std::string& group) {
  std::map<std::int64_t, std::string> by_index;
  for (const std::string& name : file.members(group)) {
    const std::string object = std::string(group).append("/").append(name);
    const std::int64_t index = file.integer_attribute(object, kIndex);
    if (!by_index.emplace(index, name).second) {
      file.refuse(object, "index " + std::to_string(index) + " is taken");
    }
  }
  std::vector<std::string> names;
  names.reserve(by_index.size());
  for (auto& [index, name] : by_index) names.push_back(std::move(name));
  return names;
}

ElementKind read_kind(const Hdf5Reader& file, const std::string& object) {
  try {
    return element_kind_from(file.string_attribute(object, "kind"));
  } catch (const InputError& error) {
    file.refuse(object, error.what());
  }
}

void read_nodes(const Hdf5Reader& file, Mesh& mesh) {
  const std::vector<double> values = file.read_doubles("/nodes", {kAnyExtent, 3}, "m");
  mesh.nodes.resize(values.size() / 3);
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
    mesh.nodes[n] = {values[3 * n], values[3 * n + 1], values[3 * n + 2]};
  }
}

void read_materials(const Hdf5Reader& file, Mesh& mesh) {
  for (const std::string& name : ordered_members(file, "/materials")) {
    const std::string group = "/materials/" + name;
    mesh.materials.push_back(
        {.name = name,
         .youngs_modulus_Pa = file.double_attribute(group, "youngs_modulus_Pa"),
         .poissons_ratio = file.double_attribute(group, "poissons_ratio"),
         .density_kg_m3 = file.double_attribute(group, "density_kg_m3")});
  }
}

void read_blocks(const Hdf5Reader& file, Mesh& mesh) {
  for (const std::string& part : ordered_members(file, "/blocks")) {
    const std::string group = "/blocks/" + part;
    const ElementKind kind = read_kind(file, group);
    const std::string material = file.string_attribute(group, "material");
    const auto found = std::find_if(mesh.materials.begin(), mesh.materials.end(),
                                    [&](const Material& m) { return m.name == material; });
    if (found == mesh.materials.end()) {
      file.refuse(group, "its material '" + material + "' is not under /materials");
    }
    mesh.blocks.push_back({.part = part,
                           .kind = kind,
                           .material = static_cast<std::size_t>(found - mesh.materials.begin()),
                           .nodes = file.read_integers(group + "/connectivity",
                                                       {kAnyExtent, nodes_per_element(kind)})});
  }
}

void read_sets(const Hdf5Reader& file, Mesh& mesh) {
  for (const std::string& name : ordered_members(file, "/node_sets")) {
    mesh.node_sets.push_back(
        {.name = name, .nodes = file.read_integers("/node_sets/" + name, {kAnyExtent})});
  }
  for (const std::string& name : ordered_members(file, "/face_sets")) {
    const std::string dataset = "/face_sets/" + name;
    const ElementKind kind = read_kind(file, dataset);
    mesh.face_sets.push_back(
        {.name = name,
         .kind = kind,
         .nodes = file.read_integers(dataset, {kAnyExtent, nodes_per_element(kind)})});
  }
}

}  // namespace

void write_mesh(const std::filesystem::path& path, const MeshFile& file) {
  check(file.mesh);
  Hdf5Writer writer(path, kMeshFormat);
  write_nodes(writer, file.mesh);
  write_materials(writer, file.mesh);
  write_blocks(writer, file.mesh);
  write_sets(writer, file.mesh);
  write_provenance(writer, file.provenance);
  writer.commit();
}

MeshFile read_mesh(const std::filesystem::path& path) {
  const Hdf5Reader reader(path, kMeshFormat);
  MeshFile file;
  read_nodes(reader, file.mesh);
  read_materials(reader, file.mesh);
  read_blocks(reader, file.mesh);
  read_sets(reader, file.mesh);
  try {
    check(file.mesh);
  } catch (const InputError& error) {
    reader.refuse("/", error.what());
  }
  file.provenance = read_provenance(reader);
  return file;
}

}  // namespace flexneck::mesher
