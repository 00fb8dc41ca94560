// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "geometry/foundation/hdf5_file.h"
#include "geometry/foundation/output_file.h"
#include "mesher/mesh/mesh.h"

namespace flexneck::mesher {

/// A dataset of an HDF5 file in the folder of the document.
struct XdmfItem {
  std::filesystem::path file;  ///< only its name is written
  std::string dataset;
  Shape shape;             ///< its extents
  bool is_double = false;  ///< doubles, otherwise 32-bit integers
};

/// An XDMF document, version 2, for ParaView: several grids, whose data are in HDF5 files. It is
/// written by commit(), or not at all.
class XdmfDocument {
 public:
  /// @throws InputError if the folder cannot be written.
  XdmfDocument(const std::filesystem::path& path, const std::string& name);

  /// @param connectivity (elements, nodes per element), in the order of edge_order.h
  /// @param positions (n, 3)
  void begin_grid(const std::string& name, ElementKind kind, const XdmfItem& connectivity,
                  const XdmfItem& positions);
  /// @param nodes (k): indices of the points
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

/// Name of a block's grid: the part, with the kind if the part has elements of several.
std::string grid_name(const Mesh& mesh, const ElementBlock& block);

/// Path of the file with data that ParaView reads in another order: "mesh_view.h5" beside
/// "mesh.h5".
std::filesystem::path view_file(const std::filesystem::path& file);
/// Dataset into which write_xdmf() writes the elements of a block.
XdmfItem view_connectivity(const std::filesystem::path& mesh_file, const ElementBlock& block);

}  // namespace flexneck::mesher
