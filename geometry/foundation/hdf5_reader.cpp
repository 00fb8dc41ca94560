// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/foundation/hdf5_file.h"
#include "geometry/foundation/hdf5_source.h"

namespace flexneck {

namespace fs = std::filesystem;

namespace {

std::string text_of(const Shape& shape) {
  std::string text = "(";
  for (std::size_t i = 0; i < shape.size(); ++i) {
    text += (i > 0 ? ", " : "") + (shape[i] == kAnyExtent ? "any" : std::to_string(shape[i]));
  }
  return text + ")";
}

bool fits(const Shape& found, const Shape& expected) {
  return std::equal(found.begin(), found.end(), expected.begin(), expected.end(),
                    [](std::size_t f, std::size_t e) { return e == kAnyExtent || f == e; });
}

/// Refuses a number out of range, for which HDF5 would take the nearest that fits.
H5T_conv_ret_t refuse_out_of_range(H5T_conv_except_t problem, hid_t /*from*/, hid_t /*to*/,
                                   void* /*value*/, void* /*converted*/, void* is_out_of_range) {
  if (problem != H5T_CONV_EXCEPT_RANGE_HI && problem != H5T_CONV_EXCEPT_RANGE_LOW) {
    return H5T_CONV_UNHANDLED;
  }
  *static_cast<bool*>(is_out_of_range) = true;
  return H5T_CONV_ABORT;
}

}  // namespace

struct Hdf5Reader::Impl {
  Impl(fs::path path, std::string made_by) : source(std::move(path), std::move(made_by)) {}

  Hdf5Source source;

  template <typename T>
  std::vector<T> read_numbers(const std::string& name, const Shape& expected, hid_t type,
                              H5T_class_t type_class, const std::string& type_name) const {
    const Hdf5Handle dataset = source.open_dataset(name);
    const Hdf5Handle stored = source.opened(H5Dget_type(dataset.get()), H5Tclose, name);
    if (H5Tget_class(stored.get()) != type_class) {
      source.refuse(name, "expected " + type_name + ", found another type");
    }
    const Shape found = source.shape_of(dataset, name);
    if (!fits(found, expected)) {
      source.refuse(name, "expected the shape " + text_of(expected) + ", found " + text_of(found));
    }
    std::size_t count = 1;
    for (const std::size_t extent : found) count *= extent;
    std::vector<T> values(count);
    if (count == 0) return values;
    bool is_out_of_range = false;
    const Hdf5Handle transfer = source.opened(H5Pcreate(H5P_DATASET_XFER), H5Pclose, name);
    if (H5Pset_type_conv_cb(transfer.get(), refuse_out_of_range, &is_out_of_range) < 0) {
      source.fail(name);
    }
    const herr_t status =
        H5Dread(dataset.get(), type, H5S_ALL, H5S_ALL, transfer.get(), values.data());
    if (is_out_of_range) {
      source.refuse(name, "expected " + type_name + " of " + std::to_string(8 * sizeof(T)) +
                              " bits, found a value out of range");
    }
    if (status < 0) source.fail(name);
    return values;
  }

  template <typename T>
  T read_attribute(const std::string& object, const std::string& name, hid_t type,
                   const std::vector<H5T_class_t>& accepted, const std::string& type_name) const {
    const Hdf5Handle attribute = source.open_attribute(object, name);
    const Hdf5Handle stored = source.opened(H5Aget_type(attribute.get()), H5Tclose, object);
    if (std::find(accepted.begin(), accepted.end(), H5Tget_class(stored.get())) == accepted.end()) {
      source.refuse(object, "expected the attribute '" + name + "' to be one " + type_name);
    }
    T value{};
    if (H5Aread(attribute.get(), type, &value) < 0) source.fail(object + ", attribute " + name);
    return value;
  }
};

Hdf5Reader::Hdf5Reader(fs::path path, const FileFormat& format)
    : impl_(std::make_unique<Impl>(std::move(path), std::string(format.made_by))) {
  const std::string expected(format.name);
  const bool says = impl_->source.has_attribute("/", "format");
  const std::string found = says ? string_attribute("/", "format") : "an unknown format";
  if (found != expected) {
    refuse("/", "expected the format '" + expected + "', found '" + found + "'");
  }
  const std::int64_t version = integer_attribute("/", "schema_version");
  if (version != format.schema_version)
    refuse("/", "expected schema_version " + std::to_string(format.schema_version) + ", found " +
                    std::to_string(version));
}

std::string format_of(const fs::path& path) {
  if (!is_hdf5(path)) return {};
  const Hdf5Source source(path, "flexneck run");
  return source.has_attribute("/", "format") ? source.string_attribute("/", "format") : "";
}

Hdf5Reader::~Hdf5Reader() = default;

const fs::path& Hdf5Reader::path() const { return impl_->source.path(); }

Trust Hdf5Reader::trust() const { return impl_->source.trust(); }

bool Hdf5Reader::has(const std::string& object) const { return impl_->source.exists(object); }

std::vector<std::string> Hdf5Reader::members(const std::string& group) const {
  return impl_->source.members(group);
}

std::vector<std::string> Hdf5Reader::attributes(const std::string& object) const {
  return impl_->source.attributes(object);
}

Shape Hdf5Reader::shape(const std::string& dataset) const {
  return impl_->source.shape_of(impl_->source.open_dataset(dataset), dataset);
}

std::vector<double> Hdf5Reader::read_doubles(const std::string& dataset, const Shape& expected,
                                             std::string_view unit) const {
  std::vector<double> values = impl_->read_numbers<double>(dataset, expected, H5T_NATIVE_DOUBLE,
                                                           H5T_FLOAT, "floating-point numbers");
  if (!std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); })) {
    refuse(dataset, "expected finite numbers, found NaN or infinity");
  }
  const std::string found = string_attribute(dataset, "units");
  if (found != unit) {
    refuse(dataset, "expected the unit '" + std::string(unit) + "', found '" + found + "'");
  }
  return values;
}

std::vector<std::int32_t> Hdf5Reader::read_integers(const std::string& dataset,
                                                    const Shape& expected) const {
  return impl_->read_numbers<std::int32_t>(dataset, expected, H5T_NATIVE_INT32, H5T_INTEGER,
                                           "integers");
}

std::vector<std::string> Hdf5Reader::read_strings(const std::string& dataset) const {
  return impl_->source.read_strings(dataset);
}

std::string Hdf5Reader::string_attribute(const std::string& object, const std::string& name) const {
  return impl_->source.string_attribute(object, name);
}

double Hdf5Reader::double_attribute(const std::string& object, const std::string& name) const {
  const auto value = impl_->read_attribute<double>(object, name, H5T_NATIVE_DOUBLE,
                                                   {H5T_FLOAT, H5T_INTEGER}, "number");
  if (!std::isfinite(value)) {
    refuse(object, "expected a finite number as attribute '" + name + "'");
  }
  return value;
}

std::int64_t Hdf5Reader::integer_attribute(const std::string& object,
                                           const std::string& name) const {
  const auto value =
      impl_->read_attribute<std::int64_t>(object, name, H5T_NATIVE_INT64, {H5T_INTEGER}, "integer");
  // HDF5 returns this maximum for an unsigned number that does not fit.
  if (value == std::numeric_limits<std::int64_t>::max()) {
    refuse(object, "the attribute '" + name + "' is out of the range of signed 64-bit integers");
  }
  return value;
}

void Hdf5Reader::refuse(const std::string& object, const std::string& problem) const {
  impl_->source.refuse(object, problem);
}

}  // namespace flexneck
