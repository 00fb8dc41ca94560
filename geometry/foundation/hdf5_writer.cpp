// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <functional>
#include <iterator>
#include <map>
#include <numeric>

#include "geometry/foundation/atomic_file.h"
#include "geometry/foundation/content_hash.h"
#include "geometry/foundation/error.h"
#include "geometry/foundation/hdf5_file.h"
#include "geometry/foundation/hdf5_handle.h"
#include "geometry/foundation/hdf5_output_driver.h"
#include "geometry/foundation/normal_number.h"

namespace flexneck {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kBlockValues = 8192;        ///< written at once to an appended dataset
constexpr std::size_t kMinCompressed = 512;       ///< values below which compression costs space
constexpr unsigned kCompressionLevel = 1;         ///< higher levels take longer and save no more
constexpr std::size_t kMaxAttributeSize = 64000;  ///< HDF5 has 64 KiB for a whole attribute

std::size_t count_of(const Shape& shape) {
  return std::accumulate(shape.begin(), shape.end(), std::size_t{1}, std::multiplies<>());
}

void require_count(std::size_t count, const Shape& shape, const std::string& dataset) {
  if (count != count_of(shape)) {
    throw std::logic_error("shape of " + dataset + " does not fit its " + std::to_string(count) +
                           " values");
  }
}

Shape with_rows(std::size_t rows, const Shape& row) {
  Shape shape = {rows};
  shape.insert(shape.end(), row.begin(), row.end());
  return shape;
}

std::vector<hsize_t> extents_of(const Shape& shape) { return {shape.begin(), shape.end()}; }

/// A dataset that grows by rows, in compressed blocks. It is created when its first block is full,
/// or at the end; a dataset too small to compress is written like any other.
struct Appended {
  Shape row;
  std::string unit;
  std::vector<double> waiting = {};
  Hdf5Handle dataset = {};
  std::size_t rows = 0;  ///< already written

  std::size_t row_size() const { return std::max<std::size_t>(1, count_of(row)); }
  std::size_t block_rows() const { return std::max<std::size_t>(1, kBlockValues / row_size()); }
};

}  // namespace

struct Hdf5Writer::Impl {
  explicit Impl(fs::path path) : bytes(std::move(path)) {}

  AtomicFile bytes;  ///< HDF5 writes into it, so it is destroyed last
  Hdf5Handle file;
  std::map<std::string, Appended> appended;

  /// @throws ComputationError unless HDF5 has succeeded and every byte was written.
  void require(bool done, const std::string& object) const {
    bytes.require_written();
    if (!done) {
      throw ComputationError(bytes.path().string() + ": " + object +
                             ": HDF5 cannot write it; check the free memory");
    }
  }

  /// Properties with which HDF5 creates missing groups.
  Hdf5Handle link_properties(const std::string& object) const {
    Hdf5Handle properties(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
    require(H5Pset_create_intermediate_group(properties.get(), 1) >= 0, object);
    return properties;
  }

  /// Type of UTF-8 strings of fixed length in bytes, padded with zeros.
  Hdf5Handle string_type(std::size_t length, const std::string& object) const {
    Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
    require(H5Tset_size(type.get(), std::max<std::size_t>(1, length)) >= 0 &&
                H5Tset_cset(type.get(), H5T_CSET_UTF8) >= 0 &&
                H5Tset_strpad(type.get(), H5T_STR_NULLPAD) >= 0,
            object);
    return type;
  }

  /// Properties of a dataset without time stamp.
  /// @param block extents of a chunk, or none if the dataset does not grow
  Hdf5Handle dataset_properties(const Shape& block, const std::string& name) const {
    Hdf5Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    require(H5Pset_obj_track_times(properties.get(), false) >= 0, name);
    require(block.empty() || H5Pset_chunk(properties.get(), static_cast<int>(block.size()),
                                          extents_of(block).data()) >= 0,
            name);
    if (!block.empty()) {
      require(H5Pset_shuffle(properties.get()) >= 0 &&
                  H5Pset_deflate(properties.get(), kCompressionLevel) >= 0,
              name);
    }
    return properties;
  }

  Hdf5Handle create_dataset(const std::string& name, hid_t type, const Shape& shape,
                            const Shape& block) const {
    std::vector<hsize_t> largest = extents_of(shape);
    if (!block.empty()) largest.front() = H5S_UNLIMITED;
    const Hdf5Handle space(
        H5Screate_simple(static_cast<int>(shape.size()), extents_of(shape).data(), largest.data()),
        H5Sclose);
    const Hdf5Handle creation = dataset_properties(block, name);
    const Hdf5Handle links = link_properties(name);
    Hdf5Handle dataset(H5Dcreate2(file.get(), name.c_str(), type, space.get(), links.get(),
                                  creation.get(), H5P_DEFAULT),
                       H5Dclose);
    require(static_cast<bool>(dataset), name);
    return dataset;
  }

  void write_dataset(const std::string& name, hid_t type, const void* data, const Shape& shape) {
    Hdf5Handle dataset = create_dataset(name, type, shape, {});
    const bool done = count_of(shape) == 0 ||
                      H5Dwrite(dataset.get(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) >= 0;
    require(done && dataset.close(), name);
  }

  /// Opens the object of an attribute; creates it as a group if it does not exist.
  Hdf5Handle open_object(const std::string& name) {
    Hdf5Handle object(H5Oopen(file.get(), name.c_str(), H5P_DEFAULT), H5Oclose);
    if (object) return object;
    const Hdf5Handle links = link_properties(name);
    Hdf5Handle group(H5Gcreate2(file.get(), name.c_str(), links.get(), H5P_DEFAULT, H5P_DEFAULT),
                     H5Gclose);
    require(static_cast<bool>(group), name);
    return group;
  }

  void write_attribute(const std::string& object, const std::string& name, hid_t type,
                       const void* data) {
    Hdf5Handle owner = open_object(object);
    const Hdf5Handle space(H5Screate(H5S_SCALAR), H5Sclose);
    Hdf5Handle attribute(
        H5Acreate2(owner.get(), name.c_str(), type, space.get(), H5P_DEFAULT, H5P_DEFAULT),
        H5Aclose);
    const bool done = attribute && H5Awrite(attribute.get(), type, data) >= 0;
    require(done && attribute.close() && owner.close(), object + ", attribute " + name);
  }

  void write_text_attribute(const std::string& object, const std::string& name,
                            std::string_view value) {
    if (value.size() > kMaxAttributeSize) {
      throw InputError(bytes.path().string() + ": " + object + ", attribute " + name +
                       ": a text of " + std::to_string(value.size()) +
                       " bytes is longer than an HDF5 attribute allows, " +
                       std::to_string(kMaxAttributeSize));
    }
    const Hdf5Handle type = string_type(value.size(), object);
    const std::string text = value.empty() ? std::string(1, '\0') : std::string(value);
    write_attribute(object, name, type.get(), text.data());
  }

  void write_block(const std::string& name, Appended& rows) {
    const std::size_t count = rows.waiting.size() / rows.row_size();
    if (!rows.dataset) {
      const Shape block = with_rows(count, rows.row);
      rows.dataset = create_dataset(name, H5T_NATIVE_DOUBLE, with_rows(0, rows.row), block);
    }
    const std::vector<hsize_t> extents = extents_of(with_rows(rows.rows + count, rows.row));
    const std::vector<hsize_t> size = extents_of(with_rows(count, rows.row));
    std::vector<hsize_t> start(size.size(), 0);
    start.front() = rows.rows;
    require(H5Dset_extent(rows.dataset.get(), extents.data()) >= 0, name);
    const Hdf5Handle target(H5Dget_space(rows.dataset.get()), H5Sclose);
    const Hdf5Handle source(H5Screate_simple(static_cast<int>(size.size()), size.data(), nullptr),
                            H5Sclose);
    require(H5Sselect_hyperslab(target.get(), H5S_SELECT_SET, start.data(), nullptr, size.data(),
                                nullptr) >= 0,
            name);
    require(H5Dwrite(rows.dataset.get(), H5T_NATIVE_DOUBLE, source.get(), target.get(), H5P_DEFAULT,
                     rows.waiting.data()) >= 0,
            name);
    rows.rows += count;
    rows.waiting.clear();
  }

  void finish(const std::string& name, Appended& rows) {
    if (!rows.dataset && rows.waiting.size() < kMinCompressed) {
      const Shape shape = with_rows(rows.waiting.size() / rows.row_size(), rows.row);
      write_dataset(name, H5T_NATIVE_DOUBLE, rows.waiting.data(), shape);
    } else {
      if (!rows.waiting.empty()) write_block(name, rows);
      require(rows.dataset.close(), name);
    }
    write_text_attribute(name, "units", rows.unit);
  }
};

Hdf5Writer::Hdf5Writer(fs::path path, const FileFormat& format)
    : impl_(std::make_unique<Impl>(std::move(path))) {
  start_hdf5();
  const Hdf5Handle access = output_access(impl_->bytes);
  const Hdf5Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
  impl_->require(H5Pset_userblock(creation.get(), kHashBlockSize) >= 0, "/");
  impl_->file = Hdf5Handle(
      H5Fcreate(impl_->bytes.path().c_str(), H5F_ACC_TRUNC, creation.get(), access.get()),
      H5Fclose);
  impl_->require(static_cast<bool>(impl_->file), "/");
  write_attribute("/", "format", format.name);
  write_attribute("/", "schema_version", static_cast<std::int64_t>(format.schema_version));
  write_attribute("/", "units", std::string_view("SI"));
}

Hdf5Writer::~Hdf5Writer() = default;

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
  std::size_t length = 1;
  for (const std::string& value : values) length = std::max(length, value.size());
  std::string texts;
  texts.reserve(length * values.size());
  for (const std::string& value : values) texts += value + std::string(length - value.size(), '\0');
  const Hdf5Handle type = impl_->string_type(length, dataset);
  impl_->write_dataset(dataset, type.get(), texts.data(), {values.size()});
}

void Hdf5Writer::append(const std::string& dataset, std::span<const double> rows, const Shape& row,
                        std::string_view unit) {
  Appended& known =
      impl_->appended.try_emplace(dataset, Appended{row, std::string(unit)}).first->second;
  if (row != known.row || unit != known.unit || rows.size() % known.row_size() != 0) {
    throw std::logic_error("rows of " + dataset + " differ from those before");
  }
  const std::size_t block = known.block_rows() * known.row_size();
  while (!rows.empty()) {
    const auto part = rows.first(std::min(rows.size(), block - known.waiting.size()));
    std::ranges::transform(part, std::back_inserter(known.waiting), normal_number);
    rows = rows.subspan(part.size());
    if (known.waiting.size() == block) impl_->write_block(dataset, known);
  }
}

void Hdf5Writer::write_attribute(const std::string& object, const std::string& name,
                                 std::string_view value) {
  impl_->write_text_attribute(object, name, value);
}

void Hdf5Writer::write_attribute(const std::string& object, const std::string& name, double value) {
  impl_->write_attribute(object, name, H5T_NATIVE_DOUBLE, &value);
}

void Hdf5Writer::write_attribute(const std::string& object, const std::string& name,
                                 std::int64_t value) {
  impl_->write_attribute(object, name, H5T_NATIVE_INT64, &value);
}

void Hdf5Writer::complete(Durability durability) {
  for (auto& [name, rows] : impl_->appended) impl_->finish(name, rows);
  impl_->require(impl_->file.close(), "the file");
  AtomicFile& bytes = impl_->bytes;
  if (durability == Durability::content) bytes.start_sync();
  bytes.write_at(0, hash_block_of(bytes.descriptor(), bytes.path()));
}

void Hdf5Writer::commit(Durability durability) {
  complete(durability);
  impl_->bytes.commit(durability);
}

void Hdf5Writer::commit(const std::function<void()>& meanwhile) {
  complete(Durability::content);
  if (meanwhile) meanwhile();
  impl_->bytes.commit(Durability::content);
}

}  // namespace flexneck
