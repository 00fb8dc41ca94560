// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "geometry/foundation/temporary_folder.h"

namespace flexneck::mesher {

/// Formats of files that a mesh or a geometry may come from. Each holds data, none is a program.
enum class ForeignFormat {
  msh,   ///< gmsh's mesh, version 2 or 4
  unv,   ///< I-deas universal file
  bdf,   ///< Nastran bulk data
  inp,   ///< Abaqus or CalculiX input
  step,  ///< STEP, ISO 10303-21
  brep,  ///< OpenCASCADE's own format
};

/// The format by the ending of the file's name.
/// @throws InputError listing the known endings, or saying that a .geo file is a script.
ForeignFormat foreign_format_of(const std::filesystem::path& file);

/// The contents of a file, checked to be of the format of its ending.
/// @throws InputError if it cannot be read or is of another format.
std::string checked_contents(const std::filesystem::path& file);

/// A private copy of a file, checked to be of the format of its ending. gmsh chooses its reader by
/// ending and first bytes, runs unknown files as scripts, and afterwards runs FILE.opt beside the
/// file. So it never sees the user's file but this copy, which lies alone in a new folder under a
/// safe name and was checked byte for byte as it lies there. The folder is removed with the object.
///
/// The signature is checked and, where a format has one, the structure: a .msh begins with
/// $MeshFormat in the first byte, has a version that gmsh knows, and has no text between its
/// sections. The meaning of its numbers is left to the reader; a file made to crash the reader is
/// not kept from doing so.
class CheckedCopy {
 public:
  /// @throws InputError if the file cannot be read or is not of the format of its ending.
  explicit CheckedCopy(const std::filesystem::path& file);

  ForeignFormat format() const { return format_; }
  const std::filesystem::path& path() const { return path_; }

 private:
  ForeignFormat format_;
  TemporaryFolder folder_;
  std::filesystem::path path_;
};

}  // namespace flexneck::mesher
