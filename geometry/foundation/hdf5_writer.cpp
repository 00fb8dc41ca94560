// SPDX-License-Identifier: GPL-3.0-or-later
#include <cerrno>
#include <cstring>
#include <functional>
#include <numeric>
#include <unistd.h>

#include "geometry/foundation/error.h"
#include "geometry/foundation/hdf5_file.h"
#include "geometry/foundation/hdf5_handle.h"

namespace flexneck {

namespace fs = std::filesystem;

struct Hdf5Writer::Impl {
  fs::path path;
  fs::path temporary;
  Hdf5Handle file;

  [[noreturn]] void fail(const std::string& object) const {
    throw ComputationError(path.string() + ": cannot write " + object +
                           "; is the disk full or the folder gone?");
  }

  /// Missing groups are made, and nothing carries a time stamp.
  Hdf5Handle link_properties() const {
    Hdf5Handle properties(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
    H5Pset_create_intermediate_group(properties.get(), 1);
    return properties;
  }

  void write_dataset(const std::string& name, hid_t type, const void* data, const Shape& shape) {
    const std::vector<hsize_t> extents(shape.begin(), shape.end());
    const Hdf5Handle space(
        H5Screate_simple(static_cast<int>(extents.size()), extents.data(), nullptr), H5Sclose);
    const Hdf5Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    H5Pset_obj_track_times(creation.get(), false);
    const Hdf5Handle links = link_properties();
    const Hdf5Handle dataset(H5Dcreate2(file.get(), name.c_str(), type, space.get(), links.get(),
                                        creation.get(), H5P_DEFAULT),
                             H5Dclose);
    if (!dataset) fail(name);
    const bool empty = H5Sget_simple_extent_npoints(space.get()) == 0;
    if (!empty && H5Dwrite(dataset.get(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) < 0) {
      fail(name);
    }
  }

  /// The object of an attribute; a group that does not exist yet is made.
  Hdf5Handle open_object(const std::string& name) {
    Hdf5Handle object(H5Oopen(file.get(), name.c_str(), H5P_DEFAULT), H5Oclose);
    if (object) return object;
    const Hdf5Handle links = link_properties();
    Hdf5Handle group(H5Gcreate2(file.get(), name.c_str(), links.get(), H5P_DEFAULT, H5P_DEFAULT),
                     H5Gclose);
    if (!group) fail(name);
    return group;
  }

  void write_attribute(const std::string& object, const std::string& name, hid_t type,
                       const void* data) {
    const Hdf5Handle owner = open_object(object);
    const Hdf5Handle space(H5Screate(H5S_SCALAR), H5Sclose);
    const Hdf5Handle attribute(
        H5Acreate2(owner.get(), name.c_str(), type, space.get(), H5P_DEFAULT, H5P_DEFAULT),
        H5Aclose);
    if (!attribute || H5Awrite(attribute.get(), type, data) < 0) {
      fail(object + ", attribute " + name);
    }
  }
};

namespace {

std::size_t count_of(const Shape& shape) {
  return std::accumulate(shape.begin(), shape.end(), std::size_t{1}, std::multiplies<>());
}

void require_count(std::size_t count, const Shape& shape, const std::string& dataset) {
  if (count != count_of(shape)) {
    throw std::logic_error("shape of " + dataset + " does not fit its " + std::to_string(count) +
                           " values");
  }
}

}  // namespace

Hdf5Writer::Hdf5Writer(fs::path path, const FileFormat& format) : impl_(std::make_unique<Impl>()) {
  silence_hdf5();
  impl_->path = std::move(path);
  impl_->temporary = impl_->path;
  impl_->temporary += ".part";
  errno = 0;
  impl_->file = Hdf5Handle(
      H5Fcreate(impl_->temporary.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose);
  if (!impl_->file) {
    const std::string reason = errno != 0 ? std::strerror(errno) : "HDF5 refused";
    throw InputError(impl_->path.string() + ": cannot be written (" + reason +
                     "); choose another folder with -o");
  }
  write_attribute("/", "format", format.name);
  write_attribute("/", "schema_version", static_cast<std::int64_t>(format.schema_version));
  write_attribute("/", "units", std::string_view("SI"));
}

Hdf5Writer::~Hdf5Writer() {
  if (!impl_->file) return;
  impl_->file.reset();
  std::error_code ignored;
  fs::remove(impl_->temporary, ignored);
}

void Hdf5Writer::write(const std::string& dataset, std::span<const double> values,
                       const Shape& shape, std::string_view unit) {
  require_count(values.size(), shape, dataset);
  impl_->write_dataset(dataset, H5T_NATIVE_DOUBLE, values.data(), shape);
  write_attribute(dataset, "units", unit);
}

void Hdf5Writer::write(const std::string& dataset, std::span<const std::int32_t> values,
                       const Shape& shape) {
  require_count(values.size(), shape, dataset);
  impl_->write_dataset(dataset, H5T_NATIVE_INT32, values.data(), shape);
}

void Hdf5Writer::write(const std::string& dataset, const std::vector<std::string>& values) {
  std::vector<const char*> texts;
  texts.reserve(values.size());
  for (const std::string& value : values) texts.push_back(value.c_str());
  const Hdf5Handle type = hdf5_string_type();
  impl_->write_dataset(dataset, type.get(), texts.data(), {values.size()});
}

void Hdf5Writer::write_attribute(const std::string& object, const std::string& name,
                                 std::string_view value) {
  const std::string text(value);
  const char* const pointer = text.c_str();
  const Hdf5Handle type = hdf5_string_type();
  impl_->write_attribute(object, name, type.get(), &pointer);
}

void Hdf5Writer::write_attribute(const std::string& object, const std::string& name, double value) {
  impl_->write_attribute(object, name, H5T_NATIVE_DOUBLE, &value);
}

void Hdf5Writer::write_attribute(const std::string& object, const std::string& name,
                                 std::int64_t value) {
  impl_->write_attribute(object, name, H5T_NATIVE_INT64, &value);
}

void Hdf5Writer::commit() {
  if (H5Fflush(impl_->file.get(), H5F_SCOPE_LOCAL) < 0) impl_->fail("the file");
  impl_->file.reset();
  std::error_code error;
  fs::rename(impl_->temporary, impl_->path, error);
  if (error) impl_->fail("the file (" + error.message() + ")");
}

}  // namespace flexneck
