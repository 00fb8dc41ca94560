// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "geometry/foundation/temporary_folder.h"

namespace flexneck::mesher {

/// Kinds of files that a mesh or a geometry may come from. Each is data, none a program.
enum class ForeignFormat {
  msh,   ///< gmsh's mesh, version 2 or 4
  unv,   ///< I-deas universal file
  bdf,   ///< Nastran bulk data
  inp,   ///< Abaqus or CalculiX input
  step,  ///< STEP, ISO 10303-21
  brep,  ///< OpenCASCADE's own
};

/// By the ending of the name.
/// @throws InputError listing the known endings, or saying that a .geo file is a script.
ForeignFormat foreign_format_of(const std::filesystem::path& file);

/// The contents of a file that is what its ending says.
/// @throws InputError if it cannot be read or is something else.
std::string checked_contents(const std::filesystem::path& file);

/// A private copy of a file that is what its ending says. gmsh chooses its reader by ending and
/// first bytes, runs what it does not know as a script, and afterwards runs FILE.opt beside the
/// file. So it never sees the user's file: it gets this copy, which lies alone in a fresh folder
/// under a name of ours, and was checked byte for byte as it lies there. The folder goes with the
/// object.
///
/// Checked are the signature and, as far as a format has one, the structure: a .msh begins with
/// $MeshFormat in the first byte, has a version that gmsh knows, and has no text between its
/// sections. What the numbers in it mean is for the reader; a file made to crash the reader is not
/// kept from doing so.
class CheckedCopy {
 public:
  /// @throws InputError if the file cannot be read or is something else than its ending says.
  explicit CheckedCopy(const std::filesystem::path& file);

  ForeignFormat format() const { return format_; }
  const std::filesystem::path& path() const { return path_; }

 private:
  ForeignFormat format_;
  TemporaryFolder folder_;
  std::filesystem::path path_;
};

}  // namespace flexneck::mesher
