// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "geometry/foundation/hdf5_file.h"
#include "geometry/foundation/output_file.h"
#include "mesher/mesh/mesh.h"

namespace flexneck::mesher {

/// A dataset of an HDF5 file that lies beside the document.
struct XdmfItem {
  std::filesystem::path file;  ///< only its name is written
  std::string dataset;
  Shape shape;             ///< its extents
  bool is_double = false;  ///< or 32-bit integers
};

/// An XDMF document, version 2, for ParaView: grids side by side, the heavy data elsewhere. It is
/// written by commit(), or not at all.
class XdmfDocument {
 public:
  /// @throws InputError if the folder cannot be written.
  XdmfDocument(const std::filesystem::path& path, const std::string& name);

  /// @param connectivity (elements, nodes per element), in the order of edge_order.h
  /// @param positions (n, 3)
  void begin_grid(const std::string& name, ElementKind kind, const XdmfItem& connectivity,
                  const XdmfItem& positions);
  /// @param nodes (k): a point for each
  void begin_points(const std::string& name, const XdmfItem& nodes, const XdmfItem& positions);
  void end_grid();

  /// @param values (elements, 1)
  void element_scalar(const std::string& name, const XdmfItem& values);
  /// @param values (n, 3)
  void node_vector(const std::string& name, const XdmfItem& values);
  /// @param values (n, 1)
  void node_scalar(const std::string& name, const XdmfItem& values);
  /// @param values (n, 9), row-major
  void node_tensor(const std::string& name, const XdmfItem& values);

  void commit();

 private:
  void begin(const std::string& name, const std::string& topology, const XdmfItem& connectivity,
             const XdmfItem& positions);
  void attribute(const std::string& name, const std::string& type, const XdmfItem& values);

  OutputFile file_;
};

/// The part, and the kind where the part has elements of several.
std::string grid_name(const Mesh& mesh, const ElementBlock& block);

/// What ParaView reads besides a file, in an order of its own: "mesh_view.h5" beside "mesh.h5".
std::filesystem::path view_file(const std::filesystem::path& file);
/// Where write_xdmf() puts the elements of a block.
XdmfItem view_connectivity(const std::filesystem::path& mesh_file, const ElementBlock& block);

}  // namespace flexneck::mesher
