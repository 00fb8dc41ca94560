// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <string>
#include <vector>

#include "geometry/foundation/content_hash.h"
#include "geometry/foundation/files_read.h"
#include "geometry/foundation/origin.h"

namespace flexneck {

class Hdf5Writer;
class Hdf5Reader;

/// One input of a study as the user wrote it.
struct Parameter {
  std::string key;    ///< dotted, e.g. "geometry.plate_diameter"
  std::string value;  ///< with its unit, e.g. "3.4 in"
  Origin origin = Origin::synthetic;
  std::string note;  ///< source or reason, may be empty
};

/// A file that a result was computed from.
struct InputFile {
  std::string name;  ///< without its folder, so that results do not depend on where they were
                     ///< computed
  std::string hash;  ///< 128-bit XXH3 of the contents, 32 hexadecimal digits

  bool operator==(const InputFile&) const = default;
};

/// The files whose content is known. Several may have the same name, in different folders.
std::vector<InputFile> input_files(const std::vector<FileRead>& reads);

/// Origin of a result; stored in the group /provenance of every HDF5 file of this program.
struct Provenance {
  std::string program;   ///< e.g. "flexneck 0.1.0"
  std::string git_hash;  ///< hash of the sources of the build, or "unknown"
  std::vector<InputFile> inputs;
  std::vector<Parameter> parameters;
  std::map<std::string, std::string> libraries;  ///< name to version
};

void write_provenance(Hdf5Writer& file, const Provenance& provenance);
/// Reads the provenance; empty if the file has none, as those of other programs.
Provenance read_provenance(const Hdf5Reader& file);

}  // namespace flexneck
