// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/exchange/xdmf_document.h"

#include <algorithm>

#include "geometry/foundation/xml_text.h"

namespace flexneck::mesher {
namespace {

std::string text_of(const Shape& shape) {
  std::string text;
  for (const std::size_t extent : shape) text += (text.empty() ? "" : " ") + std::to_string(extent);
  return text;
}

std::string xml_of(const XdmfItem& item) {
  return "<DataItem Format=\"HDF\" NumberType=\"" + std::string(item.is_double ? "Float" : "Int") +
         "\" Precision=\"" + (item.is_double ? "8" : "4") + "\" Dimensions=\"" +
         text_of(item.shape) + "\">" + xml_text(item.file.filename().string()) + ":" +
         xml_text(item.dataset) + "</DataItem>";
}

}  // namespace

XdmfDocument::XdmfDocument(const std::filesystem::path& path, const std::string& name)
    : file_(path) {
  file_.write("<?xml version=\"1.0\"?>\n<Xdmf Version=\"2.0\">\n<Domain>\n<Grid Name=\"" +
              xml_text(name) + "\" GridType=\"Collection\" CollectionType=\"Spatial\">\n");
}

void XdmfDocument::begin(const std::string& name, const std::string& topology,
                         const XdmfItem& connectivity, const XdmfItem& positions) {
  file_.write("<Grid Name=\"" + xml_text(name) + "\">\n<Topology TopologyType=" + topology +
              " NumberOfElements=\"" + std::to_string(connectivity.shape.at(0)) + "\">" +
              xml_of(connectivity) + "</Topology>\n<Geometry GeometryType=\"XYZ\">" +
              xml_of(positions) + "</Geometry>\n");
}

void XdmfDocument::begin_grid(const std::string& name, ElementKind kind,
                              const XdmfItem& connectivity, const XdmfItem& positions) {
  begin(name, "\"" + std::string(traits_of(kind).xdmf_topology) + "\"", connectivity, positions);
}

void XdmfDocument::begin_points(const std::string& name, const XdmfItem& nodes,
                                const XdmfItem& positions) {
  begin(name, "\"Polyvertex\" NodesPerElement=\"1\"", nodes, positions);
}

void XdmfDocument::end_grid() { file_.write("</Grid>\n"); }

void XdmfDocument::attribute(const std::string& name, const std::string& type,
                             const XdmfItem& values) {
  file_.write("<Attribute Name=\"" + xml_text(name) + "\" " + type + ">" + xml_of(values) +
              "</Attribute>\n");
}

void XdmfDocument::element_scalar(const std::string& name, const XdmfItem& values) {
  attribute(name, "AttributeType=\"Scalar\" Center=\"Cell\"", values);
}

void XdmfDocument::node_vector(const std::string& name, const XdmfItem& values) {
  attribute(name, "AttributeType=\"Vector\" Center=\"Node\"", values);
}

void XdmfDocument::node_scalar(const std::string& name, const XdmfItem& values) {
  attribute(name, "AttributeType=\"Scalar\" Center=\"Node\"", values);
}

void XdmfDocument::node_tensor(const std::string& name, const XdmfItem& values) {
  attribute(name, "AttributeType=\"Tensor\" Center=\"Node\"", values);
}

void XdmfDocument::commit() {
  file_.write("</Grid>\n</Domain>\n</Xdmf>\n");
  file_.commit(Durability::none);
}

std::string grid_name(const Mesh& mesh, const ElementBlock& block) {
  const bool is_mixed =
      std::count_if(mesh.blocks.begin(), mesh.blocks.end(),
                    [&](const ElementBlock& other) { return other.part == block.part; }) > 1;
  return block.part + (is_mixed ? " " + std::string(name_of(block.kind)) : "");
}

std::filesystem::path view_file(const std::filesystem::path& file) {
  return file.parent_path() / (file.stem().string() + "_view.h5");
}

XdmfItem view_connectivity(const std::filesystem::path& mesh_file, const ElementBlock& block) {
  return {view_file(mesh_file),
          "/parts/" + block.part + "/" + std::string(name_of(block.kind)) + "/connectivity",
          {block.size(), traits_of(block.kind).xdmf_nodes}};
}

}  // namespace flexneck::mesher
