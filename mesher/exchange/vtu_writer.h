// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "mesher/mesh/mesh.h"

namespace flexneck::mesher {

/// A field at the nodes, (n, components), row-major: a vector, a scalar, or a tensor of nine.
struct NodeVectors {
  std::string name;
  std::span<const double> values;
  int components = 3;
};

/// Writes a mesh as an unstructured grid of VTK (.vtu, XML with raw appended data), which ParaView,
/// VTK and meshio read: elements in VTK's order of nodes, with the numbers of their part and
/// material ("part", "material"; from 0, in the order of parts_of() and Mesh::materials). Nodes
/// that VTK does not know, beyond the 13 of a pyramid, are points of no cell.
class VtuWriter {
 public:
  explicit VtuWriter(const Mesh& mesh);

  /// @param positions_m  (n, 3), row-major
  /// @throws InputError if the folder cannot be written.
  void write(const std::filesystem::path& path, std::span<const double> positions_m,
             const std::vector<NodeVectors>& vectors) const;

 private:
  std::size_t nodes_ = 0;
  std::vector<std::int64_t> connectivity_, offsets_;
  std::vector<std::uint8_t> types_;
  std::vector<std::int32_t> parts_, materials_;
};

/// Positions of the nodes, (n, 3), as the writer takes them.
std::span<const double> node_coordinates(const Mesh& mesh);

/// A file of a collection over time (.pvd), which ParaView plays.
struct TimedFile {
  double time_s = 0;
  std::string name;  ///< path relative to the folder of the collection
};
/// @throws InputError if the folder cannot be written.
void write_pvd(const std::filesystem::path& path, const std::vector<TimedFile>& files);

}  // namespace flexneck::mesher
