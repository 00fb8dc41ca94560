// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/foundation/hdf5_dictionary.h"

#include <vector>

#include "geometry/foundation/atomic_file.h"
#include "geometry/foundation/error.h"
#include "geometry/foundation/hdf5_handle.h"
#include "geometry/foundation/hdf5_output_driver.h"

namespace flexneck {

struct Hdf5Dictionary::Impl {
  explicit Impl(std::filesystem::path path) : bytes(std::move(path)) {}

  AtomicFile bytes;  ///< HDF5 writes into it, so it is destroyed last
  Hdf5Handle file;

  void require(bool done, const std::string& key) const {
    bytes.require_written();
    if (!done) throw ComputationError(bytes.path().string() + ": HDF5 cannot write " + key);
  }

  Hdf5Handle text_type(std::size_t length, const std::string& key) const {
    Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
    require(
        type && H5Tset_size(type.get(), length) >= 0 && H5Tset_cset(type.get(), H5T_CSET_UTF8) >= 0,
        key);
    return type;
  }

  void name_type(const Hdf5Handle& item, const char* datatype, const std::string& key) const {
    const Hdf5Handle type = text_type(H5T_VARIABLE, key);
    const Hdf5Handle space(H5Screate(H5S_SCALAR), H5Sclose);
    Hdf5Handle attribute(
        H5Acreate2(item.get(), "datatype", type.get(), space.get(), H5P_DEFAULT, H5P_DEFAULT),
        H5Aclose);
    const bool done = attribute && H5Awrite(attribute.get(), type.get(), &datatype) >= 0;
    require(done && attribute.close(), key);
  }

  void write(const std::string& key, const char* datatype, hid_t type, const void* data,
             const Shape& shape) const {
    const std::vector<hsize_t> extents(shape.begin(), shape.end());
    const Hdf5Handle space(
        shape.empty() ? H5Screate(H5S_SCALAR)
                      : H5Screate_simple(static_cast<int>(shape.size()), extents.data(), nullptr),
        H5Sclose);
    const Hdf5Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    require(creation && H5Pset_obj_track_times(creation.get(), false) >= 0, key);
    Hdf5Handle item(H5Dcreate2(file.get(), key.c_str(), type, space.get(), H5P_DEFAULT,
                               creation.get(), H5P_DEFAULT),
                    H5Dclose);
    const bool done =
        item && (H5Sget_simple_extent_npoints(space.get()) == 0 ||
                 H5Dwrite(item.get(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) >= 0);
    require(done, key);
    name_type(item, datatype, key);
    require(item.close(), key);
  }
};

Hdf5Dictionary::Hdf5Dictionary(std::filesystem::path path)
    : impl_(std::make_unique<Impl>(std::move(path))) {
  start_hdf5();
  const Hdf5Handle access = output_access(impl_->bytes);
  impl_->file = Hdf5Handle(
      H5Fcreate(impl_->bytes.path().c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access.get()), H5Fclose);
  impl_->require(static_cast<bool>(impl_->file), "the file");
}

Hdf5Dictionary::~Hdf5Dictionary() = default;

void Hdf5Dictionary::integer(const std::string& key, std::int64_t value) {
  impl_->write(key, "int", H5T_NATIVE_INT64, &value, {});
}

void Hdf5Dictionary::real(const std::string& key, double value) {
  impl_->write(key, "float", H5T_NATIVE_DOUBLE, &value, {});
}

void Hdf5Dictionary::text(const std::string& key, std::string_view value) {
  const Hdf5Handle type = impl_->text_type(value.size() + 1, key);
  impl_->write(key, "str", type.get(), std::string(value).c_str(), {});
}

void Hdf5Dictionary::array(const std::string& key, std::span<const double> values,
                           const Shape& shape) {
  impl_->write(key, "ndarray", H5T_NATIVE_DOUBLE, values.data(), shape);
}

void Hdf5Dictionary::array(const std::string& key, std::span<const std::int32_t> values,
                           const Shape& shape) {
  impl_->write(key, "ndarray", H5T_NATIVE_INT32, values.data(), shape);
}

void Hdf5Dictionary::empty_dictionary(const std::string& key) {
  Hdf5Handle group(
      H5Gcreate2(impl_->file.get(), key.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
  impl_->require(static_cast<bool>(group), key);
  impl_->name_type(group, "dict", key);
  impl_->require(group.close(), key);
}

void Hdf5Dictionary::commit() {
  impl_->require(impl_->file.close(), "the file");
  impl_->bytes.commit();
}

}  // namespace flexneck
