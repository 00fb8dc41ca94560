// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/mesh/mesh_file.h"

#include <algorithm>
#include <charconv>
#include <map>
#include <utility>

#include "geometry/foundation/error.h"
#include "mesher/mesh/connections_file.h"

namespace flexneck::mesher {
namespace {

/// HDF5 returns the members of a group in alphabetical order; this attribute keeps the mesh's
/// order.
const std::string kIndex = "index";

using Vectors = std::vector<std::array<double, 3>>;

std::vector<double> flattened(const Vectors& vectors) {
  std::vector<double> values;
  values.reserve(3 * vectors.size());
  for (const auto& vector : vectors) values.insert(values.end(), vector.begin(), vector.end());
  return values;
}

Vectors vectors_from(const std::vector<double>& values) {
  Vectors vectors(values.size() / 3);
  for (std::size_t n = 0; n < vectors.size(); ++n) {
    vectors[n] = {values[3 * n], values[3 * n + 1], values[3 * n + 2]};
  }
  return vectors;
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
    const std::string dataset = "/blocks/" + block.part + "/" + std::string(name_of(block.kind));
    file.write(dataset, block.nodes, {block.size(), nodes_per_element(block.kind)});
    file.write_attribute(dataset, kIndex, static_cast<std::int64_t>(b));
    file.write_attribute(dataset, "material", mesh.materials[block.material].name);
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
    const std::string group = "/face_sets/" + set.name;
    for (std::size_t b = 0; b < set.blocks.size(); ++b) {
      const FaceBlock& block = set.blocks[b];
      const std::string dataset = group + "/" + std::string(name_of(block.kind));
      file.write(dataset, block.nodes, {block.size(), nodes_per_element(block.kind)});
      file.write_attribute(dataset, kIndex, static_cast<std::int64_t>(b));
    }
    file.write_attribute(group, kIndex, static_cast<std::int64_t>(s));
  }
}

void write_slits(Hdf5Writer& file, const Mesh& mesh) {
  for (std::size_t s = 0; s < mesh.slits.size(); ++s) {
    const Slit& slit = mesh.slits[s];
    const std::string group = "/slits/" + slit.name;
    const std::size_t pairs = slit.lower.size();
    file.write(group + "/lower", slit.lower, {pairs});
    file.write(group + "/upper", slit.upper, {pairs});
    file.write(group + "/normals", flattened(slit.normals), {pairs, 3}, "1");
    file.write(group + "/areas", slit.areas_m2, {pairs}, "m^2");
    file.write_attribute(group, kIndex, static_cast<std::int64_t>(s));
    file.write_attribute(group, "tied", static_cast<std::int64_t>(slit.tied));
  }
}

/// Groups and datasets below `groups` that hold data, ordered by their attribute `index`, which
/// counts from 0. Names in `groups` are those of groups.
std::vector<std::string> ordered_members(const Hdf5Reader& file,
                                         const std::vector<std::string>& groups) {
  std::map<std::int64_t, std::string> by_index;
  for (const std::string& group : groups) {
    for (const std::string& name : file.members(group)) {
      const std::string object = std::string(group).append("/").append(name);
      const std::int64_t index = file.integer_attribute(object, kIndex);
      if (!by_index.emplace(index, object).second) {
        file.refuse(object, "index " + std::to_string(index) + " occurs twice");
      }
    }
  }
  std::vector<std::string> objects;
  objects.reserve(by_index.size());
  for (auto& [index, object] : by_index) objects.push_back(std::move(object));
  return objects;
}

/// The part of a path after the last '/'.
std::string last_name(const std::string& object) { return object.substr(object.rfind('/') + 1); }

ElementKind kind_of(const Hdf5Reader& file, const std::string& dataset) {
  try {
    return element_kind_from(last_name(dataset));
  } catch (const InputError& error) {
    file.refuse(dataset, error.what());
  }
}

void read_materials(const Hdf5Reader& file, Mesh& mesh) {
  for (const std::string& group : ordered_members(file, {"/materials"})) {
    mesh.materials.push_back(
        {.name = last_name(group),
         .youngs_modulus_Pa = file.double_attribute(group, "youngs_modulus_Pa"),
         .poissons_ratio = file.double_attribute(group, "poissons_ratio"),
         .density_kg_m3 = file.double_attribute(group, "density_kg_m3")});
  }
}

std::size_t read_material(const Hdf5Reader& file, const std::string& dataset, const Mesh& mesh) {
  const std::string material = file.string_attribute(dataset, "material");
  const auto found = std::find_if(mesh.materials.begin(), mesh.materials.end(),
                                  [&](const Material& m) { return m.name == material; });
  if (found == mesh.materials.end()) {
    file.refuse(dataset, "its material '" + material + "' is not under /materials");
  }
  return static_cast<std::size_t>(found - mesh.materials.begin());
}

void read_blocks(const Hdf5Reader& file, Mesh& mesh) {
  std::vector<std::string> parts;
  for (const std::string& part : file.members("/blocks")) parts.push_back("/blocks/" + part);
  for (const std::string& dataset : ordered_members(file, parts)) {
    const ElementKind kind = kind_of(file, dataset);
    mesh.blocks.push_back(
        {.part = last_name(dataset.substr(0, dataset.rfind('/'))),
         .kind = kind,
         .material = read_material(file, dataset, mesh),
         .nodes = file.read_integers(dataset, {kAnyExtent, nodes_per_element(kind)})});
  }
}

void read_sets(const Hdf5Reader& file, Mesh& mesh) {
  for (const std::string& dataset : ordered_members(file, {"/node_sets"})) {
    mesh.node_sets.push_back(
        {.name = last_name(dataset), .nodes = file.read_integers(dataset, {kAnyExtent})});
  }
  for (const std::string& group : ordered_members(file, {"/face_sets"})) {
    FaceSet set{.name = last_name(group), .blocks = {}};
    for (const std::string& dataset : ordered_members(file, {group})) {
      const ElementKind kind = kind_of(file, dataset);
      set.blocks.push_back(
          {kind, file.read_integers(dataset, {kAnyExtent, nodes_per_element(kind)})});
    }
    mesh.face_sets.push_back(std::move(set));
  }
}

void read_slits(const Hdf5Reader& file, Mesh& mesh) {
  for (const std::string& group : ordered_members(file, {"/slits"})) {
    Slit slit;
    slit.name = last_name(group);
    slit.tied = file.integer_attribute(group, "tied") != 0;
    slit.lower = file.read_integers(group + "/lower", {kAnyExtent});
    slit.upper = file.read_integers(group + "/upper", {slit.lower.size()});
    slit.normals = vectors_from(file.read_doubles(group + "/normals", {slit.lower.size(), 3}, "1"));
    slit.areas_m2 = file.read_doubles(group + "/areas", {slit.lower.size()}, "m^2");
    mesh.slits.push_back(std::move(slit));
  }
}

void check_partition(const Mesh& mesh, int count, const std::vector<std::int32_t>& processes) {
  const std::string what = "partition " + std::to_string(count);
  std::size_t elements = 0;
  for (const ElementBlock& block : mesh.blocks) elements += block.size();
  if (processes.size() != elements) {
    throw InputError(what + " has " + std::to_string(processes.size()) + " entries, expected " +
                     std::to_string(elements) + ", the number of elements");
  }
  for (const std::int32_t process : processes) {
    if (process < 0 || process >= count) {
      throw InputError(what + " names process " + std::to_string(process) + ", expected 0 to " +
                       std::to_string(count - 1));
    }
  }
}

void check_node_order(const Mesh& mesh, const std::vector<std::int32_t>& order) {
  if (order.empty()) return;
  std::vector<bool> seen(mesh.nodes.size(), false);
  bool sound = order.size() == mesh.nodes.size();
  for (const std::int32_t node : order) {
    const auto n = static_cast<std::size_t>(node);
    sound = sound && node >= 0 && n < seen.size() && !seen[n];
    if (!sound) break;
    seen[n] = true;
  }
  if (!sound) throw InputError("the node order is not a permutation of the nodes");
}

void check(const MeshFile& file) {
  check(file.mesh);
  for (const auto& [count, processes] : file.partitions) {
    check_partition(file.mesh, count, processes);
  }
  check_node_order(file.mesh, file.node_order);
}

void write_orders(Hdf5Writer& writer, const MeshFile& file) {
  for (const auto& [count, processes] : file.partitions) {
    writer.write("/partition/" + std::to_string(count), processes, {processes.size()});
  }
  if (!file.node_order.empty()) {
    writer.write("/node_order", file.node_order, {file.node_order.size()});
  }
}

void read_orders(const Hdf5Reader& reader, MeshFile& file) {
  for (const std::string& name : reader.members("/partition")) {
    const std::string dataset = "/partition/" + name;
    int count = 0;
    const auto* const end = name.data() + name.size();
    const auto [stop, error] = std::from_chars(name.data(), end, count);
    if (error != std::errc() || stop != end || count < 1) {
      reader.refuse(dataset, "expected the number of processes as its name");
    }
    file.partitions[count] = reader.read_integers(dataset, {kAnyExtent});
  }
  if (reader.has("/node_order")) {
    file.node_order = reader.read_integers("/node_order", {kAnyExtent});
  }
}

}  // namespace

void write_mesh(const std::filesystem::path& path, const MeshFile& file) {
  check(file);
  Hdf5Writer writer(path, kMeshFormat);
  writer.write("/nodes", flattened(file.mesh.nodes), {file.mesh.nodes.size(), 3}, "m");
  write_materials(writer, file.mesh);
  write_blocks(writer, file.mesh);
  write_sets(writer, file.mesh);
  write_slits(writer, file.mesh);
  write_connections(writer, file.mesh.connections);
  write_orders(writer, file);
  write_provenance(writer, file.provenance);
  writer.commit();
}

MeshFile read_mesh(const std::filesystem::path& path) {
  const Hdf5Reader reader(path, kMeshFormat);
  MeshFile file;
  file.mesh.nodes = vectors_from(reader.read_doubles("/nodes", {kAnyExtent, 3}, "m"));
  read_materials(reader, file.mesh);
  read_blocks(reader, file.mesh);
  read_sets(reader, file.mesh);
  read_slits(reader, file.mesh);
  file.mesh.connections = read_connections(reader);
  read_orders(reader, file);
  try {
    check(file);
  } catch (const InputError& error) {
    reader.refuse("/", error.what());
  }
  file.provenance = read_provenance(reader);
  return file;
}

}  // namespace flexneck::mesher
