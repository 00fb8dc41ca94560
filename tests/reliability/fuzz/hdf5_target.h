// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>

#include "tests/reliability/fuzz/hdf5_edits.h"
#include "tests/reliability/fuzz/input_folder.h"

namespace flexneck::fuzz {

/// A reader of HDF5 files, and the sound file whose edited versions it reads.
class Hdf5Target {
 public:
  using OnPath = std::function<void(const std::filesystem::path&)>;

  /// @param write_sound writes the file
  explicit Hdf5Target(const OnPath& write_sound);

  /// @param read gets the path of the edited file; it may throw InputError
  int run(const std::uint8_t* data, std::size_t size, const OnPath& read) const;

  const InputFolder& folder() const { return folder_; }

 private:
  InputFolder folder_;
  Hdf5Edits edits_;
};

}  // namespace flexneck::fuzz
