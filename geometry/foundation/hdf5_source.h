// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "geometry/foundation/hdf5_file.h"
#include "geometry/foundation/hdf5_handle.h"

namespace flexneck {

bool is_hdf5(const std::filesystem::path& path);

/// An HDF5 file that is open for reading; its objects are checked before they are trusted. Private
/// to the reader. Members throw as Hdf5Reader's do.
class Hdf5Source {
 public:
  Hdf5Source(std::filesystem::path path, std::string made_by);

  const std::filesystem::path& path() const { return path_; }
  Trust trust() const { return trust_; }

  /// Owns an identifier that HDF5 has opened; fails if it is invalid.
  Hdf5Handle opened(hid_t id, Hdf5Handle::Closer closer, const std::string& object) const;

  bool exists(const std::string& object) const;
  std::vector<std::string> members(const std::string& group) const;
  std::vector<std::string> attributes(const std::string& object) const;

  /// Opens a dataset after checking that its data are in this file and as large as stated.
  Hdf5Handle open_dataset(const std::string& name) const;
  bool has_attribute(const std::string& object, const std::string& name) const;
  /// Opens an attribute that holds one value.
  Hdf5Handle open_attribute(const std::string& object, const std::string& name) const;
  Shape shape_of(const Hdf5Handle& dataset, const std::string& name) const;

  /// Reads strings of fixed or variable length.
  std::vector<std::string> read_strings(const std::string& dataset) const;
  std::string string_attribute(const std::string& object, const std::string& name) const;

  [[noreturn]] void refuse(const std::string& object, const std::string& problem) const;
  /// Reports that HDF5 failed: a foreign file is damaged; for a verified one the cause lies
  /// elsewhere.
  [[noreturn]] void fail(const std::string& object) const;

 private:
  H5O_type_t type_of(const std::string& object) const;
  /// Names listed by HDF5.
  /// @param name_at writes the k-th name into a buffer, or only returns its length
  template <typename NameAt>
  std::vector<std::string> names(const std::string& object, hsize_t count,
                                 const NameAt& name_at) const;

  std::filesystem::path path_;
  std::string made_by_;
  Trust trust_ = Trust::foreign;
  std::uintmax_t size_ = 0;  ///< file size in bytes
  Hdf5Handle file_;
};

}  // namespace flexneck
