// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "geometry/foundation/hdf5_file.h"
#include "geometry/foundation/hdf5_handle.h"

namespace flexneck {

bool is_hdf5(const std::filesystem::path& path);

/// An HDF5 file that is open for reading; its objects are not trusted before they were looked at.
/// Private to the reader. Members throw as Hdf5Reader's do.
class Hdf5Source {
 public:
  Hdf5Source(std::filesystem::path path, std::string made_by);

  const std::filesystem::path& path() const { return path_; }
  Trust trust() const { return trust_; }

  /// Takes what HDF5 has opened; fails if it has not.
  Hdf5Handle opened(hid_t id, Hdf5Handle::Closer closer, const std::string& object) const;

  bool exists(const std::string& object) const;
  std::vector<std::string> members(const std::string& group) const;
  std::vector<std::string> attributes(const std::string& object) const;

  /// A dataset with its data in this file, as large as it says.
  Hdf5Handle open_dataset(const std::string& name) const;
  bool has_attribute(const std::string& object, const std::string& name) const;
  /// An attribute that holds one value.
  Hdf5Handle open_attribute(const std::string& object, const std::string& name) const;
  Shape shape_of(const Hdf5Handle& dataset, const std::string& name) const;

  /// Strings of fixed or variable length.
  std::vector<std::string> read_strings(const std::string& dataset) const;
  std::string string_attribute(const std::string& object, const std::string& name) const;

  [[noreturn]] void refuse(const std::string& object, const std::string& problem) const;
  /// HDF5 could not do it: the file is damaged, or, if it is verified, something else is at fault.
  [[noreturn]] void fail(const std::string& object) const;

 private:
  H5O_type_t type_of(const std::string& object) const;
  /// @param name_at writes the k-th name into a buffer, or only tells its length
  template <typename NameAt>
  std::vector<std::string> names(const std::string& object, hsize_t count,
                                 const NameAt& name_at) const;

  std::filesystem::path path_;
  std::string made_by_;
  Trust trust_ = Trust::foreign;
  std::uintmax_t size_ = 0;  ///< bytes of the file
  Hdf5Handle file_;
};

}  // namespace flexneck
