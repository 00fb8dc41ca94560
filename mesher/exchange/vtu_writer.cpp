// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/exchange/vtu_writer.h"

#include <algorithm>
#include <bit>
#include <cstdint>

#include "geometry/foundation/output_file.h"
#include "geometry/foundation/xml_text.h"
#include "mesher/exchange/edge_order.h"

namespace flexneck::mesher {
namespace {

static_assert(std::endian::native == std::endian::little, "the files say LittleEndian");

/// The XML document before the data, and the data, which it references by their offsets.
class Document {
 public:
  void line(const std::string& text) { head_ += text + "\n"; }

  template <typename T>
  void array(const std::string& type, const std::string& name, int components,
             std::span<const T> values) {
    line("<DataArray type=\"" + type + "\" Name=\"" + xml_text(name) + "\" NumberOfComponents=\"" +
         std::to_string(components) + "\" format=\"appended\" offset=\"" +
         std::to_string(data_.size()) + "\"/>");
    append(std::uint64_t{values.size_bytes()});
    const auto bytes = std::as_bytes(values);
    data_.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  }

  void write(const std::filesystem::path& path) const {
    OutputFile file(path);
    file.write(head_);
    file.write("<AppendedData encoding=\"raw\">\n_");
    file.write(data_);
    file.write("\n</AppendedData>\n</VTKFile>\n");
    file.commit(Durability::none);
  }

 private:
  void append(std::uint64_t number) {
    data_.append(reinterpret_cast<const char*>(&number), sizeof number);
  }

  std::string head_;
  std::string data_;
};

constexpr const char* kKind = "version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\"";

}  // namespace

VtuWriter::VtuWriter(const Mesh& mesh) : nodes_(mesh.nodes.size()) {
  const std::vector<std::string> names = parts_of(mesh);
  for (const ElementBlock& block : mesh.blocks) {
    const std::vector<std::size_t> order = edge_order(block.kind);
    const auto known = std::span(order).first(traits_of(block.kind).xdmf_nodes);
    const auto part = std::find(names.begin(), names.end(), block.part) - names.begin();
    for (std::size_t first = 0; first < block.nodes.size(); first += order.size()) {
      for (const std::size_t local : known) connectivity_.push_back(block.nodes[first + local]);
      offsets_.push_back(static_cast<std::int64_t>(connectivity_.size()));
      types_.push_back(static_cast<std::uint8_t>(traits_of(block.kind).vtk_type));
      parts_.push_back(static_cast<std::int32_t>(part));
      materials_.push_back(static_cast<std::int32_t>(block.material));
    }
  }
}

void VtuWriter::write(const std::filesystem::path& path, std::span<const double> positions_m,
                      const std::vector<NodeVectors>& vectors) const {
  Document document;
  document.line("<?xml version=\"1.0\"?>");
  document.line("<VTKFile type=\"UnstructuredGrid\" " + std::string(kKind) + ">");
  document.line("<UnstructuredGrid>\n<Piece NumberOfPoints=\"" + std::to_string(nodes_) +
                "\" NumberOfCells=\"" + std::to_string(types_.size()) + "\">");
  document.line("<Points>");
  document.array("Float64", "Points", 3, positions_m);
  document.line("</Points>\n<Cells>");
  document.array("Int64", "connectivity", 1, std::span(connectivity_));
  document.array("Int64", "offsets", 1, std::span(offsets_));
  document.array("UInt8", "types", 1, std::span(types_));
  document.line("</Cells>\n<CellData>");
  document.array("Int32", "part", 1, std::span(parts_));
  document.array("Int32", "material", 1, std::span(materials_));
  document.line("</CellData>\n<PointData>");
  for (const NodeVectors& each : vectors)
    document.array("Float64", each.name, each.components, each.values);
  document.line("</PointData>\n</Piece>\n</UnstructuredGrid>");
  document.write(path);
}

std::span<const double> node_coordinates(const Mesh& mesh) {
  return {mesh.nodes.front().data(), 3 * mesh.nodes.size()};
}

void write_pvd(const std::filesystem::path& path, const std::vector<TimedFile>& files) {
  std::string text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" " + std::string(kKind) +
                     ">\n<Collection>\n";
  for (const TimedFile& each : files)
    text += "<DataSet timestep=\"" + exact_text(each.time_s) + "\" part=\"0\" file=\"" +
            xml_text(each.name) + "\"/>\n";
  write_text(path, text + "</Collection>\n</VTKFile>\n", Durability::none);
}

}  // namespace flexneck::mesher
