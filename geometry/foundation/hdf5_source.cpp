// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/foundation/hdf5_source.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "geometry/foundation/error.h"
#include "geometry/foundation/hdf5_handle.h"
#include "geometry/foundation/input_file.h"

namespace flexneck {

namespace {

/// Bound of the compression ratio: zlib's largest is 1032.
constexpr double kMaxCompression = 1040;

std::string filter_problem(const Hdf5Handle& creation, int filters) {
  unsigned found = 0;
  for (unsigned k = 0; k < static_cast<unsigned>(filters); ++k) {
    std::size_t values = 0;
    const H5Z_filter_t filter =
        H5Pget_filter2(creation.get(), k, nullptr, &values, nullptr, 0, nullptr, nullptr);
    const bool is_known = filter == H5Z_FILTER_DEFLATE || filter == H5Z_FILTER_SHUFFLE ||
                          filter == H5Z_FILTER_FLETCHER32;
    if (!is_known || (found & (1U << static_cast<unsigned>(filter))) != 0) {
      return "expected only the filters gzip, shuffle and fletcher32, each at most once, found "
             "filter " +
             std::to_string(filter);
    }
    found |= 1U << static_cast<unsigned>(filter);
  }
  return {};
}

/// Extents, slowest index first; none if HDF5 cannot tell.
std::optional<std::vector<double>> extents_of(const Hdf5Handle& space) {
  const int rank = H5Sget_simple_extent_ndims(space.get());
  if (rank < 0) return {};
  std::vector<hsize_t> extents(static_cast<std::size_t>(rank));
  if (H5Sget_simple_extent_dims(space.get(), extents.data(), nullptr) < 0) return {};
  return std::vector<double>(extents.begin(), extents.end());
}

/// Number of chunks of a dataset with these extents.
double chunk_count(const std::vector<double>& extents, const Hdf5Handle& creation) {
  std::vector<hsize_t> chunk(extents.size(), 1);
  H5Pget_chunk(creation.get(), static_cast<int>(chunk.size()), chunk.data());
  double count = 1;
  for (std::size_t k = 0; k < chunk.size(); ++k)
    count *= std::ceil(extents[k] / static_cast<double>(chunk[k]));
  return count;
}

/// Reason to refuse a dataset: its data are in another file, compressed by a filter other than
/// gzip, shuffle and fletcher32, were never written, or are more than the file can hold. Empty text
/// if there is none; no value if HDF5 cannot tell.
/// @param file_size in bytes
std::optional<std::string> extent_problem(const Hdf5Handle& dataset, std::uintmax_t file_size) {
  const Hdf5Handle creation(H5Dget_create_plist(dataset.get()), H5Pclose);
  const H5D_layout_t layout = H5Pget_layout(creation.get());
  const int foreign_files = H5Pget_external_count(creation.get());
  const int filters = H5Pget_nfilters(creation.get());
  if (layout < 0 || foreign_files < 0 || filters < 0) return {};
  // This comes first: other queries might let HDF5 open another file.
  if (layout == H5D_VIRTUAL || foreign_files > 0) {
    return "expected data in this file, found external storage";
  }
  if (std::string problem = filter_problem(creation, filters); !problem.empty()) return problem;

  const Hdf5Handle type(H5Dget_type(dataset.get()), H5Tclose);
  const Hdf5Handle space(H5Dget_space(dataset.get()), H5Sclose);
  const std::optional<std::vector<double>> extents = extents_of(space);
  if (!type || !extents) return {};
  double bytes = static_cast<double>(H5Tget_size(type.get()));
  for (const double extent : *extents) bytes *= extent;
  if (bytes > (filters > 0 ? kMaxCompression : 1) * static_cast<double>(file_size)) {
    return "is larger than the file";
  }
  hsize_t chunks = 0;
  if (layout == H5D_CHUNKED && H5Dget_num_chunks(dataset.get(), space.get(), &chunks) < 0)
    return {};
  const bool is_written = layout == H5D_CHUNKED
                              ? static_cast<double>(chunks) >= chunk_count(*extents, creation)
                              : static_cast<double>(H5Dget_storage_size(dataset.get())) >= bytes;
  return bytes == 0 || is_written ? "" : "was never written";
}

}  // namespace

namespace fs = std::filesystem;

namespace {

/// Removes the padding with which HDF5 fills a text up to a fixed length.
std::string without_padding(std::string text, H5T_str_t padding) {
  if (padding == H5T_STR_SPACEPAD) {
    text.erase(text.find_last_not_of(' ') + 1);
  } else {
    text.erase(std::min(text.find('\0'), text.size()));
  }
  return text;
}

/// Reads strings of fixed length; none if they cannot be read.
/// @param read fills a buffer in memory with values of a type
template <typename Read>
std::vector<std::string> fixed_strings(const Hdf5Handle& type, std::size_t count,
                                       const Read& read) {
  const std::size_t length = H5Tget_size(type.get());
  std::string texts(length * count, '\0');
  if (count > 0 && read(type.get(), texts.data()) < 0) return {};
  std::vector<std::string> values;
  for (std::size_t k = 0; k < count; ++k) {
    values.push_back(without_padding(texts.substr(k * length, length), H5Tget_strpad(type.get())));
  }
  return values;
}

/// Owns the texts that HDF5 has allocated for strings of variable length.
class VariableStrings {
 public:
  explicit VariableStrings(std::size_t count) : texts_(count, nullptr) {}
  ~VariableStrings() {
    for (char* const text : texts_) H5free_memory(text);
  }
  VariableStrings(const VariableStrings&) = delete;
  VariableStrings& operator=(const VariableStrings&) = delete;

  char** data() { return texts_.data(); }
  /// h5py writes a null pointer for an empty string.
  std::vector<std::string> values() const {
    std::vector<std::string> values;
    for (const char* const text : texts_) values.emplace_back(text == nullptr ? "" : text);
    return values;
  }

 private:
  std::vector<char*> texts_;
};

/// Reads `count` strings; none if they cannot be read.
template <typename Read>
std::vector<std::string> strings(const Hdf5Handle& type, std::size_t count, const Read& read) {
  if (H5Tis_variable_str(type.get()) <= 0) return fixed_strings(type, count, read);
  VariableStrings texts(count);
  if (count > 0 && read(type.get(), texts.data()) < 0) return {};
  return texts.values();
}

}  // namespace

/// True if HDF5's signature stands at one of its permitted places: 0, 512 bytes, or 512 doubled
/// repeatedly.
bool is_hdf5(const fs::path& path) {
  constexpr std::string_view kSignature = "\x89HDF\r\n\x1a\n";
  std::error_code ignored;
  if (!fs::is_regular_file(path, ignored)) return false;
  const FileDescriptor file = open_to_read(path);
  std::array<char, kSignature.size()> found{};
  for (std::uint64_t place = 0;; place = std::max<std::uint64_t>(512, 2 * place)) {
    if (read_at(file, place, found, path) < found.size()) return false;
    if (std::string_view(found.data(), found.size()) == kSignature) return true;
  }
}

Hdf5Source::Hdf5Source(fs::path path, std::string made_by)
    : path_(std::move(path)), made_by_(std::move(made_by)) {
  start_hdf5();
  const std::string name = path_.string();
  std::error_code ignored;
  if (!fs::exists(path_, ignored)) {
    throw InputError(name + ": no such file; make it with '" + made_by_ + "'");
  }
  if (fs::is_regular_file(path_, ignored)) {
    trust_ = trust_of(path_, "make it again with '" + made_by_ + "'");
  }
  if (!is_hdf5(path_)) {
    throw InputError(name + ": expected an HDF5 file, found another kind; make it again with '" +
                     made_by_ + "'");
  }
  size_ = fs::file_size(path_);
  // No locking: files of this program are always complete, and not every file system supports
  // HDF5's locks.
  const Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  if (H5Pset_file_locking(access.get(), false, true) < 0) fail("/");
  file_ = Hdf5Handle(H5Fopen(name.c_str(), H5F_ACC_RDONLY, access.get()), H5Fclose);
  if (!file_ && trust_ == Trust::verified) fail("/");
  if (!file_) {
    throw InputError(name + ": the HDF5 file is truncated or damaged; make it again with '" +
                     made_by_ + "'");
  }
}

void Hdf5Source::refuse(const std::string& object, const std::string& problem) const {
  throw InputError(path_.string() + ": " + object + ": " + problem + "; make it again with '" +
                   made_by_ + "'");
}

void Hdf5Source::fail(const std::string& object) const {
  if (trust_ == Trust::foreign) refuse(object, "cannot be read; the file is damaged");
  throw ComputationError(
      path_.string() + ": " + object +
      ": HDF5 cannot read it, although the file is intact; check the free memory");
}

Hdf5Handle Hdf5Source::opened(hid_t id, Hdf5Handle::Closer closer,
                              const std::string& object) const {
  Hdf5Handle handle(id, closer);
  if (!handle) fail(object);
  return handle;
}

H5O_type_t Hdf5Source::type_of(const std::string& object) const {
  H5O_info_t info;
  if (H5Oget_info_by_name2(file_.get(), object.c_str(), &info, H5O_INFO_BASIC, H5P_DEFAULT) < 0) {
    fail(object);
  }
  return info.type;
}

bool Hdf5Source::exists(const std::string& object) const {
  if (object == "/") return true;
  for (std::size_t end = object.find('/', 1);; end = object.find('/', end + 1)) {
    const std::string step = object.substr(0, end);
    const htri_t found = H5Lexists(file_.get(), step.c_str(), H5P_DEFAULT);
    if (found < 0) fail(step);
    if (found == 0) return false;
    H5L_info_t link;
    if (H5Lget_info(file_.get(), step.c_str(), &link, H5P_DEFAULT) < 0) fail(step);
    if (link.type != H5L_TYPE_HARD) {
      refuse(step, "expected an object of this file, found a soft or external link");
    }
    if (end == std::string::npos) return true;
    if (type_of(step) != H5O_TYPE_GROUP) return false;
  }
}

template <typename NameAt>
std::vector<std::string> Hdf5Source::names(const std::string& object, hsize_t count,
                                           const NameAt& name_at) const {
  std::vector<std::string> names;
  for (hsize_t k = 0; k < count; ++k) {
    const ssize_t length = name_at(k, nullptr, 0);
    if (length < 0) fail(object);
    std::string name(static_cast<std::size_t>(length), '\0');
    if (name_at(k, name.data(), name.size() + 1) < 0) fail(object);
    names.push_back(std::move(name));
  }
  return names;
}

std::vector<std::string> Hdf5Source::members(const std::string& group) const {
  if (!exists(group)) return {};
  if (type_of(group) != H5O_TYPE_GROUP) refuse(group, "expected a group, found something else");
  const Hdf5Handle handle =
      opened(H5Gopen2(file_.get(), group.c_str(), H5P_DEFAULT), H5Gclose, group);
  H5G_info_t info;
  if (H5Gget_info(handle.get(), &info) < 0) fail(group);
  return names(group, info.nlinks, [&](hsize_t k, char* name, std::size_t size) {
    return H5Lget_name_by_idx(handle.get(), ".", H5_INDEX_NAME, H5_ITER_INC, k, name, size,
                              H5P_DEFAULT);
  });
}

std::vector<std::string> Hdf5Source::attributes(const std::string& object) const {
  if (!exists(object)) return {};
  H5O_info_t info;
  if (H5Oget_info_by_name2(file_.get(), object.c_str(), &info, H5O_INFO_NUM_ATTRS, H5P_DEFAULT) <
      0) {
    fail(object);
  }
  return names(object, info.num_attrs, [&](hsize_t k, char* name, std::size_t size) {
    return H5Aget_name_by_idx(file_.get(), object.c_str(), H5_INDEX_NAME, H5_ITER_INC, k, name,
                              size, H5P_DEFAULT);
  });
}

Hdf5Handle Hdf5Source::open_dataset(const std::string& name) const {
  if (!exists(name)) refuse(name, "expected a dataset, found none");
  if (type_of(name) != H5O_TYPE_DATASET) refuse(name, "expected a dataset, found something else");
  Hdf5Handle dataset = opened(H5Dopen2(file_.get(), name.c_str(), H5P_DEFAULT), H5Dclose, name);
  const std::optional<std::string> problem = extent_problem(dataset, size_);
  if (!problem) fail(name);
  if (!problem->empty()) refuse(name, *problem);
  return dataset;
}

bool Hdf5Source::has_attribute(const std::string& object, const std::string& name) const {
  const htri_t found = H5Aexists_by_name(file_.get(), object.c_str(), name.c_str(), H5P_DEFAULT);
  if (found < 0) fail(object);
  return found > 0;
}

Hdf5Handle Hdf5Source::open_attribute(const std::string& object, const std::string& name) const {
  const std::string what = "attribute '" + name + "'";
  if (!exists(object)) refuse(object, "expected an object with the " + what + ", found nothing");
  if (!has_attribute(object, name)) refuse(object, "expected the " + what + ", found none");
  Hdf5Handle attribute =
      opened(H5Aopen_by_name(file_.get(), object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT),
             H5Aclose, object);
  const Hdf5Handle space = opened(H5Aget_space(attribute.get()), H5Sclose, object);
  if (H5Sget_simple_extent_npoints(space.get()) != 1 ||
      H5Aget_storage_size(attribute.get()) > size_) {
    refuse(object, "expected the " + what + " to have one value");
  }
  return attribute;
}

Shape Hdf5Source::shape_of(const Hdf5Handle& dataset, const std::string& name) const {
  const Hdf5Handle space = opened(H5Dget_space(dataset.get()), H5Sclose, name);
  const int rank = H5Sget_simple_extent_ndims(space.get());
  if (rank < 0) fail(name);
  std::vector<hsize_t> extents(static_cast<std::size_t>(rank));
  if (H5Sget_simple_extent_dims(space.get(), extents.data(), nullptr) < 0) fail(name);
  return {extents.begin(), extents.end()};
}

std::vector<std::string> Hdf5Source::read_strings(const std::string& name) const {
  const Hdf5Handle dataset = open_dataset(name);
  const Hdf5Handle type = opened(H5Dget_type(dataset.get()), H5Tclose, name);
  if (H5Tget_class(type.get()) != H5T_STRING) refuse(name, "expected strings, found another type");
  const Shape shape = shape_of(dataset, name);
  if (shape.size() != 1) refuse(name, "expected a list of strings, found another shape");
  if (H5Tis_variable_str(type.get()) > 0) {
    const Hdf5Handle space = opened(H5Dget_space(dataset.get()), H5Sclose, name);
    hsize_t bytes = 0;
    if (H5Dvlen_get_buf_size(dataset.get(), type.get(), space.get(), &bytes) < 0) fail(name);
    if (bytes > size_) refuse(name, "expected strings that are not longer than the file");
  }
  std::vector<std::string> values = strings(type, shape[0], [&](hid_t memory_type, void* texts) {
    return H5Dread(dataset.get(), memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, texts);
  });
  if (values.size() != shape[0]) fail(name);
  return values;
}

std::string Hdf5Source::string_attribute(const std::string& object, const std::string& name) const {
  const Hdf5Handle attribute = open_attribute(object, name);
  const Hdf5Handle type = opened(H5Aget_type(attribute.get()), H5Tclose, object);
  if (H5Tget_class(type.get()) != H5T_STRING) {
    refuse(object, "expected the attribute '" + name + "' to be one string");
  }
  const std::vector<std::string> values = strings(type, 1, [&](hid_t memory_type, void* text) {
    return H5Aread(attribute.get(), memory_type, text);
  });
  if (values.size() != 1) fail(object + ", attribute " + name);
  return values[0];
}

}  // namespace flexneck
