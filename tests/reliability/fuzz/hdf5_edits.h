// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "tests/reliability/fuzz/edit_script.h"

namespace flexneck::fuzz {

/// Changes to a sound HDF5 file that are made through HDF5's own functions: whatever a script says,
/// the file stays one that HDF5 can read, and what is tried is what we make of it. Numbers and
/// texts change, extents, types, layouts and filters, attributes; objects go, move, are copied, and
/// become links.
class Hdf5Edits {
 public:
  /// @param sound bytes of a file of ours
  explicit Hdf5Edits(const std::string& sound);

  /// The bytes of the file after all edits of a script; like a foreign file it has no hash.
  std::string edited(EditScript& script) const;

 private:
  std::string image_;
  std::vector<std::string> objects_;  ///< paths of all groups and datasets
  std::vector<std::string> names_;  ///< to take for new ones: of objects, attributes, and odd ones
};

}  // namespace flexneck::fuzz
