// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "geometry/foundation/hdf5_file.h"

namespace flexneck {

/// A Python dictionary in HDF5, for programs that read one back item by item: each item has the
/// attribute `datatype`, the name of its class ("int", "float", "str", "ndarray", "dict"), of
/// variable length, and none of the attributes of this program's own formats. The file takes its
/// place on commit(); without commit() nothing is left. The same items give the same bytes. All
/// members throw ComputationError when writing fails.
class Hdf5Dictionary {
 public:
  /// @throws InputError if the folder cannot be written.
  explicit Hdf5Dictionary(std::filesystem::path path);
  ~Hdf5Dictionary();
  Hdf5Dictionary(const Hdf5Dictionary&) = delete;
  Hdf5Dictionary& operator=(const Hdf5Dictionary&) = delete;

  void integer(const std::string& key, std::int64_t value);
  void real(const std::string& key, double value);
  void text(const std::string& key, std::string_view value);
  /// Writes an array, row-major.
  void array(const std::string& key, std::span<const double> values, const Shape& shape);
  void array(const std::string& key, std::span<const std::int32_t> values, const Shape& shape);
  void empty_dictionary(const std::string& key);

  void commit();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace flexneck
