// SPDX-License-Identifier: GPL-3.0-or-later
#include <filesystem>
#include <fstream>
#include <numeric>

#include <catch2/catch.hpp>

#include "geometry/foundation/error.h"
#include "geometry/foundation/temporary_folder.h"
#include "mesher/mesh/mesh_file.h"
#include "tests/mesher/small_mesh.h"

namespace flexneck::mesher {
namespace {

using Catch::Matchers::Contains;
namespace fs = std::filesystem;

Provenance some_provenance() {
  Provenance provenance;
  provenance.program = "flexneck test";
  provenance.git_hash = "0123abcd";
  provenance.inputs = {{.name = "neck.geo", .hash = "00112233445566778899aabbccddeeff"}};
  provenance.parameters = {
      {.key = "geometry.length", .value = "5.66 in", .origin = Origin::published, .note = "paper"}};
  provenance.libraries = {{"gmsh", "4.8"}};
  return provenance;
}

}  // namespace

TEST_CASE("a mesh comes back from its file as it was") {
  const TemporaryFolder folder;
  const MeshFile out{.mesh = testing::small_mesh(), .provenance = some_provenance()};
  write_mesh(folder / "mesh.h5", out);
  const MeshFile in = read_mesh(folder / "mesh.h5");

  CHECK(in.mesh.nodes == out.mesh.nodes);
  REQUIRE(in.mesh.materials.size() == 2);
  for (std::size_t m = 0; m < 2; ++m) {  // "soft" before "hard", not in alphabetical order
    CHECK(in.mesh.materials[m].name == out.mesh.materials[m].name);
    CHECK(in.mesh.materials[m].youngs_modulus_Pa == out.mesh.materials[m].youngs_modulus_Pa);
    CHECK(in.mesh.materials[m].poissons_ratio == out.mesh.materials[m].poissons_ratio);
    CHECK(in.mesh.materials[m].density_kg_m3 == out.mesh.materials[m].density_kg_m3);
  }
  REQUIRE(in.mesh.blocks.size() == 2);
  for (std::size_t b = 0; b < 2; ++b) {
    CHECK(in.mesh.blocks[b].part == out.mesh.blocks[b].part);
    CHECK(in.mesh.blocks[b].kind == out.mesh.blocks[b].kind);
    CHECK(in.mesh.blocks[b].material == out.mesh.blocks[b].material);
    CHECK(in.mesh.blocks[b].nodes == out.mesh.blocks[b].nodes);
  }
  CHECK(in.mesh.node_set("floor").nodes == out.mesh.node_set("floor").nodes);
  CHECK(in.mesh.face_set("floor").blocks[0].kind == ElementKind::quad9);
  CHECK(in.mesh.face_set("floor").blocks[0].nodes == out.mesh.face_set("floor").blocks[0].nodes);
  CHECK(in.provenance.program == out.provenance.program);
  CHECK(in.provenance.inputs.at(0).hash == out.provenance.inputs[0].hash);
  CHECK(in.provenance.parameters.at(0).origin == Origin::published);
}

TEST_CASE("an unsound mesh is not written") {
  const TemporaryFolder folder;
  Mesh mesh = testing::small_mesh();
  mesh.nodes.push_back({0, 0, 9});
  CHECK_THROWS_AS(write_mesh(folder / "mesh.h5", {mesh, {}}), InputError);
  CHECK(fs::is_empty(folder.path()));
}

TEST_CASE("slits, partitions and the node order return from the file") {
  const TemporaryFolder folder;
  MeshFile out{testing::small_mesh(), {}};
  // The upper block gets a copy of the corner node 18, which lies between the two blocks.
  out.mesh.nodes.push_back(out.mesh.nodes[18]);
  out.mesh.blocks[0].nodes[0] = 45;
  out.mesh.slits = {{"cut", true, {18}, {45}, {{0, 0, 1}}, {0.125}}};
  out.partitions[2] = {1, 0};
  out.node_order.resize(46);
  std::iota(out.node_order.rbegin(), out.node_order.rend(), 0);
  write_mesh(folder / "mesh.h5", out);

  const MeshFile in = read_mesh(folder / "mesh.h5");
  REQUIRE(in.mesh.slits.size() == 1);
  CHECK(in.mesh.slits[0].name == "cut");
  CHECK(in.mesh.slits[0].tied);
  CHECK(in.mesh.slits[0].lower == out.mesh.slits[0].lower);
  CHECK(in.mesh.slits[0].upper == out.mesh.slits[0].upper);
  CHECK(in.mesh.slits[0].normals == out.mesh.slits[0].normals);
  CHECK(in.mesh.slits[0].areas_m2 == out.mesh.slits[0].areas_m2);
  CHECK(in.partitions == out.partitions);
  CHECK(in.node_order == out.node_order);
}

TEST_CASE("a partition or an order that does not fit the mesh is refused") {
  const TemporaryFolder folder;
  const auto writing = [&](std::map<int, std::vector<std::int32_t>> partitions,
                           std::vector<std::int32_t> order) {
    write_mesh(folder / "mesh.h5", {testing::small_mesh(), {}, partitions, order});
  };
  CHECK_THROWS_WITH(writing({{2, {0}}}, {}), Contains("partition 2 has 1 entries, expected 2"));
  CHECK_THROWS_WITH(writing({{2, {0, 2}}}, {}), Contains("names process 2, expected 0 to 1"));
  CHECK_THROWS_WITH(writing({}, {0, 1}), Contains("not a permutation"));
  CHECK_THROWS_WITH(writing({}, std::vector<std::int32_t>(45, 0)), Contains("not a permutation"));
}

TEST_CASE("a missing, truncated or foreign file is refused by name") {
  const TemporaryFolder folder;
  CHECK_THROWS_AS(read_mesh(folder / "none.h5"), InputError);
  CHECK_THROWS_WITH(read_mesh(folder / "none.h5"), Contains("none.h5"));

  write_mesh(folder / "cut.h5", {testing::small_mesh(), {}});
  fs::resize_file(folder / "cut.h5", fs::file_size(folder / "cut.h5") / 2);
  CHECK_THROWS_AS(read_mesh(folder / "cut.h5"), InputError);
  CHECK_THROWS_WITH(read_mesh(folder / "cut.h5"),
                    Contains("cut.h5: the HDF5 file is truncated or damaged") &&
                        Contains("make it again with 'flexneck mesh'"));

  std::ofstream(folder / "text.h5") << "nodes\n1 2 3\n";
  CHECK_THROWS_WITH(read_mesh(folder / "text.h5"), Contains("text.h5"));

  {
    Hdf5Writer modes(folder / "modes.h5", {"flexneck modes", 1, "flexneck modes"});
    modes.commit();
  }
  CHECK_THROWS_WITH(read_mesh(folder / "modes.h5"), Contains("modes.h5") &&
                                                        Contains("flexneck modes") &&
                                                        Contains("flexneck mesh"));
}

TEST_CASE("a file whose parts do not fit together is refused with dataset and remedy") {
  const TemporaryFolder folder;
  const auto write_part = [&](const std::string& material, std::int32_t first_node) {
    const Mesh mesh = testing::small_mesh();
    std::vector<double> nodes;
    for (const auto& node : mesh.nodes) nodes.insert(nodes.end(), node.begin(), node.end());
    Hdf5Writer file(folder / "mesh.h5", kMeshFormat);
    file.write("/nodes", nodes, {mesh.nodes.size(), 3}, "m");
    file.write_attribute("/materials/hard", "index", std::int64_t{0});
    file.write_attribute("/materials/hard", "youngs_modulus_Pa", 7e10);
    file.write_attribute("/materials/hard", "poissons_ratio", 0.33);
    file.write_attribute("/materials/hard", "density_kg_m3", 2700.0);
    std::vector<std::int32_t> connectivity = mesh.blocks[1].nodes;
    connectivity[0] = first_node;
    file.write("/blocks/lower/hex27", connectivity, {1, 27});
    file.write_attribute("/blocks/lower/hex27", "index", std::int64_t{0});
    file.write_attribute("/blocks/lower/hex27", "material", std::string_view(material));
    write_provenance(file, {});
    file.commit();
  };
  write_part("hrad", 0);
  CHECK_THROWS_WITH(read_mesh(folder / "mesh.h5"),
                    Contains("/blocks/lower/hex27") && Contains("'hrad'") &&
                        Contains("make it again with 'flexneck mesh'"));
  write_part("hard", 700);
  CHECK_THROWS_WITH(read_mesh(folder / "mesh.h5"),
                    Contains("mesh.h5") && Contains("part 'lower' refers to node 700"));
  write_part("hard", 0);
  CHECK_THROWS_WITH(read_mesh(folder / "mesh.h5"), Contains("18 nodes belong to no element"));
}

}  // namespace flexneck::mesher
