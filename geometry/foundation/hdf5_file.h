// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/foundation/content_hash.h"
#include "geometry/foundation/durability.h"

namespace flexneck {

/// Extents of a dataset, slowest index first. In an expected shape kAnyExtent matches every extent.
using Shape = std::vector<std::size_t>;
inline constexpr std::size_t kAnyExtent = static_cast<std::size_t>(-1);

/// Name and version of a file format of this program. Written as the root attributes `format` and
/// `schema_version`, next to `units` = "SI".
struct FileFormat {
  std::string_view name;     ///< e.g. "flexneck mesh"
  int schema_version;        ///< raised when the layout changes
  std::string_view made_by;  ///< the command that makes such a file, for error messages
};

/// The root attribute `format`; empty if the file is no readable HDF5 file or has none.
/// @throws InputError as trust_of() does.
std::string format_of(const std::filesystem::path& path);

/// Writes an HDF5 file that takes its place on commit(), with the hash of its content in front
/// (content_hash.h); without commit() nothing is left. Object names are absolute paths; missing
/// groups are made on the way. Strings have the length of the longest of their dataset. The same
/// writes give the same bytes. All members throw ComputationError when writing fails.
class Hdf5Writer {
 public:
  /// @throws InputError if the folder cannot be written.
  Hdf5Writer(std::filesystem::path path, const FileFormat& format);
  ~Hdf5Writer();
  Hdf5Writer(const Hdf5Writer&) = delete;
  Hdf5Writer& operator=(const Hdf5Writer&) = delete;

  /// Row-major values. `unit` is the SI unit, "1" for pure numbers.
  void write(const std::string& dataset, std::span<const double> values, const Shape& shape,
             std::string_view unit);
  /// Row-major indices or counts.
  void write(const std::string& dataset, std::span<const std::int32_t> values, const Shape& shape);
  void write(const std::string& dataset, const std::vector<std::string>& values);

  /// Adds rows to a dataset of shape (rows, row…), which is written block by block, so that it may
  /// hold more values than memory. It is complete after commit(), and has no attribute but `units`.
  /// @param rows row-major, any number of whole rows, even none
  /// @param row extents of one row, none of them 0; empty for a dataset of shape (rows)
  void append(const std::string& dataset, std::span<const double> rows, const Shape& row,
              std::string_view unit);

  void write_attribute(const std::string& object, const std::string& name, std::string_view value);
  void write_attribute(const std::string& object, const std::string& name, double value);
  void write_attribute(const std::string& object, const std::string& name, std::int64_t value);

  void commit(Durability durability = Durability::content);
  /// As commit() with the content on the disk; calls `meanwhile`, if any, while the disk takes the
  /// content. If it throws, nothing is left.
  void commit(const std::function<void()>& meanwhile);

 private:
  /// Completes the content without moving the file to its place.
  void complete(Durability durability);

  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Reads an HDF5 file of a format of this program. The hash that such files carry is checked before
/// HDF5 opens the file. A file without one is foreign, whoever wrote it: it may have numbers of any
/// width that fit and strings of either kind, but neither links to other files nor data outside of
/// itself. Every member throws InputError with one line: the file, the dataset or attribute, what
/// was expected, what was found, what to do; and ComputationError if a verified file cannot be
/// read.
class Hdf5Reader {
 public:
  /// Checks that the file is HDF5, of this format and of its schema version.
  Hdf5Reader(std::filesystem::path path, const FileFormat& format);
  ~Hdf5Reader();
  Hdf5Reader(const Hdf5Reader&) = delete;
  Hdf5Reader& operator=(const Hdf5Reader&) = delete;

  const std::filesystem::path& path() const;
  Trust trust() const;

  /// True if the group or dataset exists.
  bool has(const std::string& object) const;
  /// Names of the members of a group, in alphabetical order; empty if there is no such group.
  std::vector<std::string> members(const std::string& group) const;
  /// Names of an object's attributes, in alphabetical order; empty if there is no such object.
  std::vector<std::string> attributes(const std::string& object) const;
  Shape shape(const std::string& dataset) const;

  /// Returns values, row-major. `expected` has the dataset's rank, extents may be kAnyExtent.
  /// Values that are not finite are refused. `unit` must equal the dataset's attribute `units`.
  std::vector<double> read_doubles(const std::string& dataset, const Shape& expected,
                                   std::string_view unit) const;
  std::vector<std::int32_t> read_integers(const std::string& dataset, const Shape& expected) const;
  std::vector<std::string> read_strings(const std::string& dataset) const;

  std::string string_attribute(const std::string& object, const std::string& name) const;
  double double_attribute(const std::string& object, const std::string& name) const;
  std::int64_t integer_attribute(const std::string& object, const std::string& name) const;

  /// Reports the failure of a check that only the caller can make: throws InputError "<path>:
  /// <object>: <problem>; make it again with '<command>'".
  [[noreturn]] void refuse(const std::string& object, const std::string& problem) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace flexneck
