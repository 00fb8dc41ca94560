// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/gmsh/mesh_import.h"

#include "mesher/exchange/checked_import.h"
#include "mesher/exchange/foreign_file.h"
#include "mesher/exchange/inp_import.h"
#include "mesher/exchange/nastran_import.h"
#include "mesher/exchange/unv_import.h"
#include "mesher/gmsh/gmsh_import.h"

namespace flexneck::mesher {
namespace {

/// Reads a file with gmsh, from a checked copy.
Mesh read_with_gmsh(const ImportOptions& options, const Progress& /*progress*/, LeftOut& left_out) {
  return import_with_gmsh(CheckedCopy(options.file), options, left_out);
}

MeshReader reader_of(ForeignFormat format) {
  switch (format) {
    case ForeignFormat::inp:
      return import_inp;
    case ForeignFormat::bdf:
      return import_nastran;
    case ForeignFormat::unv:
      return import_unv;
    case ForeignFormat::msh:
    case ForeignFormat::step:
    case ForeignFormat::brep:
      break;
  }
  return read_with_gmsh;
}

}  // namespace

Mesh import_mesh(const ImportOptions& options, const Progress& progress, const Progress& warn) {
  return checked_import(options, reader_of(foreign_format_of(options.file)), progress, warn);
}

}  // namespace flexneck::mesher
