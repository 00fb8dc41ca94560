// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "tests/reliability/fuzz/edit_script.h"

namespace flexneck::fuzz {

/// Changes to a sound HDF5 file through HDF5's own functions: whatever a script says, HDF5 can read
/// the file, so that flexneck's handling of it is tested. Numbers and texts, extents, types,
/// layouts and filters, and attributes are changed; objects are removed, moved, copied, and
/// replaced by links.
class Hdf5Edits {
 public:
  /// @param sound bytes of a file of this program
  explicit Hdf5Edits(const std::string& sound);

  /// The bytes of the file after all edits of a script; like a foreign file it has no hash.
  std::string edited(EditScript& script) const;

 private:
  std::string image_;
  std::vector<std::string> objects_;  ///< paths of all groups and datasets
  std::vector<std::string> names_;  ///< names for new objects and attributes: existing and odd ones
};

}  // namespace flexneck::fuzz
