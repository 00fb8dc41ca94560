// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/exchange/xdmf_writer.h"

#include <algorithm>
#include <map>

#include "mesher/exchange/edge_order.h"
#include "mesher/exchange/output_file.h"
#include "mesher/mesh/mesh_measures.h"

namespace flexneck::mesher {
namespace {

constexpr FileFormat kViewFormat{"flexneck mesh view", 1, "flexneck mesh"};

/// Names of the XDMF model, version 2 and 3.
std::string topology_of(ElementKind kind) {
  switch (kind) {
    case ElementKind::hex8:
      return "Hexahedron";
    case ElementKind::hex20:
      return "Hexahedron_20";
    case ElementKind::hex27:
      return "Hexahedron_27";
    case ElementKind::prism15:
      return "Wedge_15";
    case ElementKind::prism18:
      return "Wedge_18";
    case ElementKind::tet10:
      return "Tetrahedron_10";
    case ElementKind::quad4:
      return "Quadrilateral";
    case ElementKind::quad8:
      return "Quadrilateral_8";
    case ElementKind::quad9:
      return "Quadrilateral_9";
    case ElementKind::tri6:
      return "Triangle_6";
  }
  return {};
}

std::string escaped(const std::string& text) {
  static const std::map<char, std::string> kEscapes = {
      {'&', "&amp;"}, {'<', "&lt;"}, {'>', "&gt;"}, {'"', "&quot;"}};
  std::string result;
  for (const char c : text) {
    const auto found = kEscapes.find(c);
    result += found == kEscapes.end() ? std::string(1, c) : found->second;
  }
  return result;
}

/// A dataset of one of the two HDF5 files.
struct DataItem {
  std::string file;
  std::string dataset;
  std::string extents;
  bool is_double = false;

  std::string xml() const {
    return "<DataItem Format=\"HDF\" NumberType=\"" + std::string(is_double ? "Float" : "Int") +
           "\" Precision=\"" + (is_double ? "8" : "4") + "\" Dimensions=\"" + extents + "\">" +
           escaped(file) + ":" + escaped(dataset) + "</DataItem>";
  }
};

std::string extents_of(std::size_t rows, std::size_t columns) {
  return std::to_string(rows) + " " + std::to_string(columns);
}

class XdmfWriter {
 public:
  XdmfWriter(const std::filesystem::path& path, const MeshFile& file)
      : mesh_(file.mesh),
        file_(file),
        mesh_file_(path.filename().string()),
        view_path_(path.parent_path() / (path.stem().string() + "_view.h5")),
        view_(view_path_, kViewFormat),
        xdmf_(path.parent_path() / (path.stem().string() + ".xdmf")) {}

  void write() {
    xdmf_.write(
        "<?xml version=\"1.0\"?>\n<Xdmf Version=\"2.0\">\n<Domain>\n"
        "<Grid Name=\"mesh\" GridType=\"Collection\" CollectionType=\"Spatial\">\n");
    std::size_t first = 0;
    for (std::size_t b = 0; b < mesh_.blocks.size(); ++b) {
      write_block(b, first);
      first += mesh_.blocks[b].size();
    }
    for (const FaceSet& set : mesh_.face_sets) write_faces(set);
    for (const NodeSet& set : mesh_.node_sets) write_nodes(set);
    xdmf_.write("</Grid>\n</Domain>\n</Xdmf>\n");
    view_.commit();
    xdmf_.commit();
  }

 private:
  void begin_grid(const std::string& name, const std::string& topology, std::size_t rows,
                  const DataItem& connectivity) {
    const DataItem nodes{mesh_file_, "/nodes", extents_of(mesh_.nodes.size(), 3), true};
    xdmf_.write("<Grid Name=\"" + escaped(name) + "\">\n<Topology TopologyType=\"" + topology +
                "\" NumberOfElements=\"" + std::to_string(rows) + "\">" + connectivity.xml() +
                "</Topology>\n<Geometry GeometryType=\"XYZ\">" + nodes.xml() + "</Geometry>\n");
  }
  void end_grid() { xdmf_.write("</Grid>\n"); }

  void attribute(const std::string& name, const DataItem& values) {
    xdmf_.write("<Attribute Name=\"" + escaped(name) +
                "\" AttributeType=\"Scalar\" Center=\"Cell\">" + values.xml() + "</Attribute>\n");
  }

  DataItem view_item(const std::string& dataset, const std::vector<std::int32_t>& values,
                     std::size_t columns) {
    const std::size_t rows = values.size() / columns;
    view_.write(dataset, values, {rows, columns});
    return {view_path_.filename().string(), dataset, extents_of(rows, columns), false};
  }

  void write_block(std::size_t index, std::size_t first_element);

  void write_faces(const FaceSet& set) {
    for (const FaceBlock& block : set.blocks) {
      const std::string kind(name_of(block.kind));
      const std::size_t n = nodes_per_element(block.kind);
      begin_grid("faces " + set.name + (set.blocks.size() > 1 ? " " + kind : ""),
                 topology_of(block.kind), block.size(),
                 {mesh_file_, "/face_sets/" + set.name + "/" + kind, extents_of(block.size(), n)});
      end_grid();
    }
  }

  void write_nodes(const NodeSet& set) {
    const std::string count = std::to_string(set.nodes.size());
    begin_grid("nodes " + set.name, "Polyvertex\" NodesPerElement=\"1", set.nodes.size(),
               {mesh_file_, "/node_sets/" + set.name, count});
    end_grid();
  }

  const Mesh& mesh_;
  const MeshFile& file_;
  std::string mesh_file_;
  std::filesystem::path view_path_;
  Hdf5Writer view_;
  OutputFile xdmf_;
};

/// The connectivity of a block in the order that VTK wants.
std::vector<std::int32_t> reordered(const ElementBlock& block) {
  const std::vector<std::size_t> order = edge_order(block.kind);
  std::vector<std::int32_t> nodes;
  nodes.reserve(block.nodes.size());
  for (std::size_t first = 0; first < block.nodes.size(); first += order.size()) {
    for (const std::size_t local : order) nodes.push_back(block.nodes[first + local]);
  }
  return nodes;
}

void XdmfWriter::write_block(std::size_t index, std::size_t first_element) {
  const ElementBlock& block = mesh_.blocks[index];
  const std::string kind(name_of(block.kind));
  const std::string group = "/parts/" + block.part + "/" + kind + "/";
  const bool is_mixed =
      std::count_if(mesh_.blocks.begin(), mesh_.blocks.end(),
                    [&](const ElementBlock& other) { return other.part == block.part; }) > 1;
  begin_grid(block.part + (is_mixed ? " " + kind : ""), topology_of(block.kind), block.size(),
             view_item(group + "connectivity", reordered(block), nodes_per_element(block.kind)));

  const std::vector<double> quality = scaled_jacobians(mesh_, block);
  view_.write(group + "scaled_jacobian", quality, {quality.size(), 1}, "1");
  attribute("scaled Jacobian", {view_path_.filename().string(), group + "scaled_jacobian",
                                extents_of(quality.size(), 1), true});
  const auto constant = [&](std::size_t value) {
    return std::vector<std::int32_t>(block.size(), static_cast<std::int32_t>(value));
  };
  attribute("material", view_item(group + "material", constant(block.material), 1));
  attribute("block", view_item(group + "block", constant(index), 1));
  for (const auto& [processes, process_of] : file_.partitions) {
    const auto begin = process_of.begin() + static_cast<std::ptrdiff_t>(first_element);
    const std::vector<std::int32_t> own(begin, begin + static_cast<std::ptrdiff_t>(block.size()));
    const std::string name = "partition " + std::to_string(processes);
    attribute(name, view_item(group + name, own, 1));
  }
  end_grid();
}

}  // namespace

void write_xdmf(const std::filesystem::path& path, const MeshFile& file) {
  XdmfWriter(path, file).write();
}

}  // namespace flexneck::mesher
