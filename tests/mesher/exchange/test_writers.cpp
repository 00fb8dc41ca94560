// SPDX-License-Identifier: GPL-3.0-or-later

#include <catch2/catch.hpp>

#include "geometry/foundation/output_file.h"
#include "mesher/exchange/edge_order.h"
#include "mesher/exchange/inp_writer.h"
#include "mesher/exchange/msh_writer.h"
#include "mesher/exchange/xdmf_writer.h"
#include "tests/mesher/exchange/files.h"
#include "tests/mesher/small_mesh.h"
#include "tests/support/files.h"

namespace flexneck::mesher {
namespace {

using Catch::Matchers::Contains;
using testing::bytes_of;
using testing::Files;

/// The small mesh with a node set that is no face set, and with positions that need all digits.
Mesh awkward_mesh() {
  Mesh mesh = testing::small_mesh();
  for (auto& node : mesh.nodes) {
    for (double& x : node) x = x / 3 + 1e-7 / 7;
  }
  mesh.node_sets.push_back({"points", {3, 17, 44}});
  return mesh;
}

/// The mesh with elements of 20 nodes: its faces have eight.
Mesh hex20_mesh() {
  const Mesh rich = awkward_mesh();
  Mesh mesh = rich;
  std::vector<bool> used(rich.nodes.size(), false);
  for (ElementBlock& block : mesh.blocks) {
    block.kind = ElementKind::hex20;
    block.nodes.resize(20);
    for (const std::int32_t node : block.nodes) used[static_cast<std::size_t>(node)] = true;
  }
  mesh.face_sets[0].blocks[0].kind = ElementKind::quad8;
  mesh.face_sets[0].blocks[0].nodes.resize(8);
  std::vector<std::int32_t> index(rich.nodes.size(), -1);
  mesh.nodes.clear();
  for (std::size_t n = 0; n < rich.nodes.size(); ++n) {
    if (!used[n]) continue;
    index[n] = static_cast<std::int32_t>(mesh.nodes.size());
    mesh.nodes.push_back(rich.nodes[n]);
  }
  const auto renumber = [&](std::vector<std::int32_t>& nodes) {
    for (std::int32_t& node : nodes) node = index[static_cast<std::size_t>(node)];
    std::erase(nodes, -1);
  };
  for (ElementBlock& block : mesh.blocks) renumber(block.nodes);
  for (NodeSet& set : mesh.node_sets) renumber(set.nodes);
  renumber(mesh.face_sets[0].blocks[0].nodes);
  return mesh;
}

void check_same(const Mesh& in, const Mesh& out) {
  CHECK(in.nodes == out.nodes);
  REQUIRE(in.blocks.size() == out.blocks.size());
  for (std::size_t b = 0; b < out.blocks.size(); ++b) {
    CHECK(in.blocks[b].part == out.blocks[b].part);
    CHECK(in.blocks[b].kind == out.blocks[b].kind);
    CHECK(in.blocks[b].nodes == out.blocks[b].nodes);
    CHECK(in.materials[in.blocks[b].material].name == out.materials[out.blocks[b].material].name);
  }
  REQUIRE(in.node_sets.size() == out.node_sets.size());
  for (const NodeSet& set : out.node_sets) CHECK(in.node_set(set.name).nodes == set.nodes);
  REQUIRE(in.face_sets.size() == out.face_sets.size());
  for (const FaceSet& set : out.face_sets) {
    REQUIRE(in.face_set(set.name).blocks.size() == set.blocks.size());
    CHECK(in.face_set(set.name).blocks[0].kind == set.blocks[0].kind);
    CHECK(in.face_set(set.name).blocks[0].nodes == set.blocks[0].nodes);
  }
}

}  // namespace

TEST_CASE("a .msh gives the mesh back to the last bit, as text and as bytes") {
  const Files files;
  const Mesh mesh = awkward_mesh();
  ImportOptions options;
  options.materials = mesh.materials;
  options.material_of_part = {{"upper", "soft"}, {"lower", "hard"}};
  for (const MshEncoding encoding : {MshEncoding::text, MshEncoding::binary}) {
    options.file = files / "mesh.msh";
    write_msh(options.file, mesh, encoding);
    check_same(import_mesh(options, {}), mesh);
  }
}

TEST_CASE("an .inp gives the mesh back with its materials, positions to 13 digits") {
  const Files files;
  const Mesh mesh = hex20_mesh();
  ImportOptions options;
  options.file = files / "mesh.inp";
  write_inp(options.file, mesh, {.reduced = {"hard"}, .fixed = {"floor"}, .mode_count = 3});
  Mesh read = import_mesh(options, {});
  for (std::size_t m = 0; m < 2; ++m) {
    CHECK(read.materials[m].youngs_modulus_Pa == mesh.materials[m].youngs_modulus_Pa);
    CHECK(read.materials[m].density_kg_m3 == mesh.materials[m].density_kg_m3);
  }
  CHECK(read.node_set("boundary").nodes == mesh.node_set("floor").nodes);
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
    for (std::size_t d = 0; d < 3; ++d) {
      CHECK(std::abs(read.nodes[n][d] - mesh.nodes[n][d]) < 1e-13);
    }
  }
  read.nodes = mesh.nodes;
  std::erase_if(read.node_sets, [](const NodeSet& set) { return set.name == "boundary"; });
  std::erase_if(read.face_sets, [](const FaceSet& set) { return set.name == "boundary"; });
  check_same(read, mesh);
  CHECK_THAT(bytes_of(options.file), Contains("TYPE=C3D20R,ELSET=lower") &&
                                         Contains("TYPE=C3D20,ELSET=upper") &&
                                         Contains("floor,1,3\n*STEP"));
}

TEST_CASE("an .inp names the element of a face also behind the first of its block") {
  Mesh mesh = hex20_mesh();
  mesh.blocks[0].nodes.insert(mesh.blocks[0].nodes.end(), mesh.blocks[1].nodes.begin(),
                              mesh.blocks[1].nodes.end());
  mesh.blocks.pop_back();
  const Files files;
  ImportOptions options;
  options.file = files / "mesh.inp";
  write_inp(options.file, mesh, {});
  CHECK_THAT(bytes_of(options.file), Contains("*SURFACE,NAME=floor,TYPE=ELEMENT\n2,S1\n"));
  const Mesh read = import_mesh(options, {});
  CHECK(read.face_set("floor").blocks[0].nodes == mesh.face_set("floor").blocks[0].nodes);
}

TEST_CASE("an .inp ties the pairs of a closed slit, but not those that are fixed") {
  Mesh mesh = hex20_mesh();
  const auto a = static_cast<std::int32_t>(mesh.nodes.size() - 1);
  mesh.nodes[mesh.nodes.size() - 2] = mesh.nodes.back();
  mesh.slits = {{"cut", true, {a - 1}, {a}, {{0, 0, 1}}, {1}}};
  const Files files;
  write_inp(files / "tied.inp", mesh, {});
  const std::string upper = std::to_string(a + 1);
  const std::string lower = std::to_string(a);
  CHECK_THAT(bytes_of(files / "tied.inp"),
             Contains("*EQUATION\n2\n" + upper + ",3,1.," + lower + ",3,-1.\n"));
  mesh.node_sets.push_back({"top", {a - 1, a}});
  write_inp(files / "fixed.inp", mesh, {.reduced = {}, .fixed = {"top"}, .mode_count = 1});
  CHECK_THAT(bytes_of(files / "fixed.inp"), !Contains("*EQUATION"));
  write_inp(files / "rollers.inp", mesh,
            {.reduced = {}, .fixed = {}, .fixed_directions = {{"top", {true, false, true}}}});
  const std::string rollers = bytes_of(files / "rollers.inp");
  CHECK_THAT(rollers, Contains("*EQUATION\n2\n" + upper + ",2,1.," + lower + ",2,-1.\n") &&
                          !Contains(upper + ",3,1.") && Contains("*BOUNDARY\ntop,1\ntop,3\n*STEP"));
  CHECK_THROWS_WITH(write_msh(files / "tied.msh", mesh, MshEncoding::text),
                    Contains("slit 'cut' is tied"));
}

TEST_CASE("what a format cannot say is refused, and no file is left") {
  const Files files;
  const auto refused = [&](const Mesh& mesh) -> std::string {
    try {
      write_inp(files / "no.inp", mesh, {});
    } catch (const InputError& error) {
      CHECK_FALSE(std::filesystem::exists(files / "no.inp"));
      CHECK_FALSE(std::filesystem::exists(files / "no.inp.part"));
      return error.what();
    }
    return "written";
  };
  CHECK_THAT(refused(awkward_mesh()), Contains("no element of kind hex27") && Contains("hex20"));
  Mesh mesh = hex20_mesh();
  mesh.blocks[0].part = "top half";
  CHECK_THAT(refused(mesh), Contains("cannot contain the part 'top half'"));
  mesh = hex20_mesh();
  mesh.node_sets[1].name = "FLOOR";
  CHECK_THAT(refused(mesh), Contains("differs only in case"));
  CHECK_THROWS_WITH(write_inp(files / "none/no.inp", hex20_mesh(), {}),
                    Contains("no.inp: cannot be written"));
}

TEST_CASE("numbers keep what their width allows") {
  CHECK(text_within(0.1, 20) == "0.10000000000000001");
  CHECK(text_within(-1.0 / 3, 20) == "-0.33333333333333331");
  for (const double x : {-1.2345678901234567e-05, 6.0221407612345678e23, -1e-300, 70e9}) {
    const std::string text = text_within(x, 20);
    CHECK(text.size() <= 20);
    CHECK(std::stod(text) == Approx(x).epsilon(1e-13));
    CHECK(std::stod(exact_text(x)) == x);
  }
}

TEST_CASE("the order of VTK and Abaqus: each midside node between its corners") {
  // vtkTriQuadraticHexahedron.h: "... 12 mid-edge nodes (0,1), (1,2), (2,3), (3,0), (4,5), (5,6),
  // (6,7), (7,4), (0,4), (1,5), (2,6), (3,7), the six mid-face nodes (0,4,7,3), (1,2,6,5),
  // (0,1,5,4), (3,7,6,2), (0,3,2,1), (4,5,6,7), and one mid-volume node".
  const std::vector<std::vector<std::size_t>> between = {{0, 1},
                                                         {1, 2},
                                                         {2, 3},
                                                         {3, 0},
                                                         {4, 5},
                                                         {5, 6},
                                                         {6, 7},
                                                         {7, 4},
                                                         {0, 4},
                                                         {1, 5},
                                                         {2, 6},
                                                         {3, 7},
                                                         {0, 4, 7, 3},
                                                         {1, 2, 6, 5},
                                                         {0, 1, 5, 4},
                                                         {3, 7, 6, 2},
                                                         {0, 3, 2, 1},
                                                         {4, 5, 6, 7},
                                                         {0, 1, 2, 3, 4, 5, 6, 7}};
  const auto reference = reference_nodes(ElementKind::hex27);
  const std::vector<std::size_t> order = edge_order(ElementKind::hex27);
  REQUIRE(order.size() == 27);
  for (std::size_t k = 0; k < between.size(); ++k) {
    std::array<double, 3> mean{};
    for (const std::size_t corner : between[k]) {
      for (std::size_t d = 0; d < 3; ++d) {
        mean[d] += reference[corner][d] / static_cast<double>(between[k].size());
      }
    }
    CHECK(reference[order[8 + k]] == mean);
  }
}

TEST_CASE("the XDMF names datasets that are there, of the extents it says") {
  const Files files;
  MeshFile file{.mesh = awkward_mesh(), .provenance = {}};
  file.partitions[2] = {1, 0};
  write_mesh(files / "mesh.h5", file);
  write_xdmf(files / "mesh.h5", file);
  const std::string xdmf = bytes_of(files / "mesh.xdmf");
  const Hdf5Reader view(files / "mesh_view.h5", {"flexneck mesh view", 2, "flexneck mesh"});
  const Hdf5Reader mesh(files / "mesh.h5", kMeshFormat);

  std::size_t items = 0;
  for (std::size_t at = xdmf.find("Dimensions=\""); at != std::string::npos;
       at = xdmf.find("Dimensions=\"", at + 1)) {
    std::istringstream extents(xdmf.substr(at + 12, xdmf.find('"', at + 12) - at - 12));
    const Shape shape{std::istream_iterator<std::size_t>(extents), {}};
    const std::size_t begin = xdmf.find('>', at) + 1;
    const std::string item = xdmf.substr(begin, xdmf.find('<', begin) - begin);
    const std::string dataset = item.substr(item.find(':') + 1);
    INFO(item);
    CHECK((item.starts_with("mesh.h5") ? mesh : view).shape(dataset) == shape);
    ++items;
  }
  // Two blocks of six items; a face set and two node sets of two.
  CHECK(items == 2 * 6 + 3 * 2);
  const auto connectivity = view.read_integers("/parts/upper/hex27/connectivity", {1, 27});
  CHECK(connectivity[9] == file.mesh.blocks[0].nodes[11]);  // VTK's second edge joins 1 and 2
  CHECK(view.read_integers("/parts/upper/hex27/partition 2", {1, 1})[0] == 1);
}

}  // namespace flexneck::mesher
