// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/exchange/xdmf_writer.h"

#include <span>

#include "mesher/exchange/edge_order.h"
#include "mesher/exchange/xdmf_document.h"
#include "mesher/mesh/mesh_measures.h"

namespace flexneck::mesher {
namespace {

constexpr FileFormat kViewFormat{"flexneck mesh view", 2, "flexneck mesh"};

class XdmfWriter {
 public:
  XdmfWriter(std::filesystem::path path, const MeshFile& file)
      : mesh_(file.mesh),
        file_(file),
        path_(std::move(path)),
        nodes_{path_, "/nodes", {mesh_.nodes.size(), 3}, true},
        view_(view_file(path_), kViewFormat),
        xdmf_(path_.parent_path() / (path_.stem().string() + ".xdmf"), "mesh") {}

  void write() {
    std::size_t first = 0;
    for (std::size_t b = 0; b < mesh_.blocks.size(); ++b) {
      write_block(b, first);
      first += mesh_.blocks[b].size();
    }
    for (const FaceSet& set : mesh_.face_sets) write_faces(set);
    for (const NodeSet& set : mesh_.node_sets) write_nodes(set);
    view_.commit(Durability::none);
    xdmf_.commit();
  }

 private:
  XdmfItem view_item(const std::string& dataset, const std::vector<std::int32_t>& values) {
    view_.write(dataset, values, {values.size(), 1});
    return {view_file(path_), dataset, {values.size(), 1}};
  }

  void write_block(std::size_t index, std::size_t first_element);

  void write_faces(const FaceSet& set) {
    for (const FaceBlock& block : set.blocks) {
      const std::string kind(name_of(block.kind));
      const std::size_t n = nodes_per_element(block.kind);
      xdmf_.begin_grid("faces " + set.name + (set.blocks.size() > 1 ? " " + kind : ""), block.kind,
                       {path_, "/face_sets/" + set.name + "/" + kind, {block.size(), n}}, nodes_);
      xdmf_.end_grid();
    }
  }

  void write_nodes(const NodeSet& set) {
    xdmf_.begin_points("nodes " + set.name, {path_, "/node_sets/" + set.name, {set.nodes.size()}},
                       nodes_);
    xdmf_.end_grid();
  }

  const Mesh& mesh_;
  const MeshFile& file_;
  std::filesystem::path path_;
  XdmfItem nodes_;
  Hdf5Writer view_;
  XdmfDocument xdmf_;
};

/// The connectivity of a block in VTK's node order, without nodes that VTK does not know.
std::vector<std::int32_t> reordered(const ElementBlock& block) {
  const std::vector<std::size_t> order = edge_order(block.kind);
  const auto shown = std::span(order).first(traits_of(block.kind).xdmf_nodes);
  std::vector<std::int32_t> nodes;
  nodes.reserve(block.nodes.size());
  for (std::size_t first = 0; first < block.nodes.size(); first += order.size()) {
    for (const std::size_t local : shown) nodes.push_back(block.nodes[first + local]);
  }
  return nodes;
}

void XdmfWriter::write_block(std::size_t index, std::size_t first_element) {
  const ElementBlock& block = mesh_.blocks[index];
  const XdmfItem connectivity = view_connectivity(path_, block);
  view_.write(connectivity.dataset, reordered(block), connectivity.shape);
  xdmf_.begin_grid(grid_name(mesh_, block), block.kind, connectivity, nodes_);

  const std::string group = "/parts/" + block.part + "/" + std::string(name_of(block.kind)) + "/";
  const std::vector<double> quality = scaled_jacobians(mesh_, block);
  view_.write(group + "scaled_jacobian", quality, {quality.size(), 1}, "1");
  xdmf_.element_scalar("scaled Jacobian",
                       {view_file(path_), group + "scaled_jacobian", {quality.size(), 1}, true});
  const auto constant = [&](std::size_t value) {
    return std::vector<std::int32_t>(block.size(), static_cast<std::int32_t>(value));
  };
  xdmf_.element_scalar("material", view_item(group + "material", constant(block.material)));
  xdmf_.element_scalar("block", view_item(group + "block", constant(index)));
  for (const auto& [processes, process_of] : file_.partitions) {
    const auto begin = process_of.begin() + static_cast<std::ptrdiff_t>(first_element);
    const std::vector<std::int32_t> own(begin, begin + static_cast<std::ptrdiff_t>(block.size()));
    const std::string name = "partition " + std::to_string(processes);
    xdmf_.element_scalar(name, view_item(group + name, own));
  }
  xdmf_.end_grid();
}

}  // namespace

void write_xdmf(const std::filesystem::path& path, const MeshFile& file) {
  XdmfWriter(path, file).write();
}

}  // namespace flexneck::mesher
