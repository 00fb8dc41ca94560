// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "geometry/foundation/error.h"
#include "geometry/foundation/hdf5_file.h"
#include "geometry/foundation/hdf5_handle.h"

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

}  // namespace

struct Hdf5Reader::Impl {
  fs::path path;
  std::string made_by;
  Hdf5Handle file;

  [[noreturn]] void refuse(const std::string& object, const std::string& problem) const {
    throw InputError(path.string() + ": " + object + ": " + problem + "; make it again with '" +
                     made_by + "'");
  }

  /// H5Lexists demands that every step of the path but the last exists.
  bool exists(const std::string& object) const {
    if (object == "/") return true;
    for (std::size_t end = object.find('/', 1);; end = object.find('/', end + 1)) {
      if (H5Lexists(file.get(), object.substr(0, end).c_str(), H5P_DEFAULT) <= 0) return false;
      if (end == std::string::npos) return true;
    }
  }

  Hdf5Handle open_dataset(const std::string& name) const {
    if (!exists(name)) refuse(name, "expected a dataset, found none");
    Hdf5Handle dataset(H5Dopen2(file.get(), name.c_str(), H5P_DEFAULT), H5Dclose);
    if (!dataset) refuse(name, "expected a dataset, found something else");
    return dataset;
  }

  Shape shape_of(const Hdf5Handle& dataset) const {
    const Hdf5Handle space(H5Dget_space(dataset.get()), H5Sclose);
    std::vector<hsize_t> extents(
        static_cast<std::size_t>(std::max(0, H5Sget_simple_extent_ndims(space.get()))));
    H5Sget_simple_extent_dims(space.get(), extents.data(), nullptr);
    return {extents.begin(), extents.end()};
  }

  template <typename T>
  std::vector<T> read_numbers(const std::string& name, const Shape& expected, hid_t type,
                              H5T_class_t type_class, const char* type_name) const {
    const Hdf5Handle dataset = open_dataset(name);
    const Hdf5Handle stored(H5Dget_type(dataset.get()), H5Tclose);
    if (H5Tget_class(stored.get()) != type_class) {
      refuse(name, std::string("expected ") + type_name + ", found another type");
    }
    const Shape found = shape_of(dataset);
    if (!fits(found, expected)) {
      refuse(name, "expected the shape " + text_of(expected) + ", found " + text_of(found));
    }
    std::size_t count = 1;
    for (const std::size_t extent : found) count *= extent;
    std::vector<T> values(count);
    if (count > 0 &&
        H5Dread(dataset.get(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0) {
      refuse(name, "cannot be read, the file is damaged");
    }
    return values;
  }

  Hdf5Handle open_attribute(const std::string& object, const std::string& name,
                            H5T_class_t type_class, const char* type_name) const {
    const std::string what = "attribute '" + name + "'";
    if (!exists(object)) refuse(object, "expected it with the " + what + ", found nothing");
    Hdf5Handle attribute(
        H5Aopen_by_name(file.get(), object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT),
        H5Aclose);
    if (!attribute) refuse(object, "expected the " + what + ", found none");
    const Hdf5Handle type(H5Aget_type(attribute.get()), H5Tclose);
    const Hdf5Handle space(H5Aget_space(attribute.get()), H5Sclose);
    if (H5Tget_class(type.get()) != type_class || H5Sget_simple_extent_npoints(space.get()) != 1) {
      refuse(object, "expected the " + what + " to be one " + type_name);
    }
    return attribute;
  }

  void check_format(const FileFormat& format, const Hdf5Reader& reader) const {
    const std::string expected(format.name);
    const bool ours = H5Aexists(file.get(), "format") > 0;
    const std::string found = ours ? reader.string_attribute("/", "format") : "an unknown format";
    if (found != expected) {
      refuse("/", "expected the format '" + expected + "', found '" + found + "'");
    }
    const std::int64_t version = reader.integer_attribute("/", "schema_version");
    if (version < 1 || version > format.schema_version) {
      refuse("/", "expected schema_version 1 to " + std::to_string(format.schema_version) +
                      ", found " + std::to_string(version));
    }
  }
};

Hdf5Reader::Hdf5Reader(fs::path path, const FileFormat& format) : impl_(std::make_unique<Impl>()) {
  silence_hdf5();
  impl_->path = std::move(path);
  impl_->made_by = format.made_by;
  const std::string name = impl_->path.string();
  std::error_code ignored;
  if (!fs::exists(impl_->path, ignored)) {
    throw InputError(name + ": no such file; make it with '" + impl_->made_by + "'");
  }
  if (!fs::is_regular_file(impl_->path, ignored) || H5Fis_hdf5(name.c_str()) <= 0) {
    throw InputError(name + ": expected an HDF5 file, found another kind or no permission to read" +
                     "; make it again with '" + impl_->made_by + "'");
  }
  impl_->file = Hdf5Handle(H5Fopen(name.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
  if (!impl_->file) {
    throw InputError(name + ": the HDF5 file is truncated or damaged; make it again with '" +
                     impl_->made_by + "'");
  }
  impl_->check_format(format, *this);
}

std::string format_of(const fs::path& path) {
  silence_hdf5();
  if (!fs::is_regular_file(path) || H5Fis_hdf5(path.c_str()) <= 0) return {};
  const Hdf5Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
  if (!file || H5Aexists(file.get(), "format") <= 0) return {};
  const Hdf5Handle attribute(H5Aopen(file.get(), "format", H5P_DEFAULT), H5Aclose);
  const Hdf5Handle stored(H5Aget_type(attribute.get()), H5Tclose);
  if (H5Tis_variable_str(stored.get()) <= 0) return {};
  const Hdf5Handle type = hdf5_string_type();
  char* text = nullptr;
  if (H5Aread(attribute.get(), type.get(), static_cast<void*>(&text)) < 0) return {};
  std::string format(text);
  H5free_memory(text);
  return format;
}

Hdf5Reader::~Hdf5Reader() = default;

const fs::path& Hdf5Reader::path() const { return impl_->path; }

bool Hdf5Reader::has(const std::string& object) const { return impl_->exists(object); }

std::vector<std::string> Hdf5Reader::members(const std::string& group) const {
  std::vector<std::string> names;
  if (!impl_->exists(group)) return names;
  const Hdf5Handle handle(H5Gopen2(impl_->file.get(), group.c_str(), H5P_DEFAULT), H5Gclose);
  if (!handle) impl_->refuse(group, "expected a group, found something else");
  const auto append = [](hid_t, const char* name, const H5L_info_t*, void* data) -> herr_t {
    static_cast<std::vector<std::string>*>(data)->emplace_back(name);
    return 0;
  };
  H5Literate(handle.get(), H5_INDEX_NAME, H5_ITER_INC, nullptr, append, &names);
  return names;
}

std::vector<std::string> Hdf5Reader::attributes(const std::string& object) const {
  std::vector<std::string> names;
  if (!impl_->exists(object)) return names;
  const auto append = [](hid_t, const char* name, const H5A_info_t*, void* data) -> herr_t {
    static_cast<std::vector<std::string>*>(data)->emplace_back(name);
    return 0;
  };
  H5Aiterate_by_name(impl_->file.get(), object.c_str(), H5_INDEX_NAME, H5_ITER_INC, nullptr, append,
                     &names, H5P_DEFAULT);
  return names;
}

Shape Hdf5Reader::shape(const std::string& dataset) const {
  return impl_->shape_of(impl_->open_dataset(dataset));
}

std::vector<double> Hdf5Reader::read_doubles(const std::string& dataset, const Shape& expected,
                                             std::string_view unit) const {
  std::vector<double> values = impl_->read_numbers<double>(dataset, expected, H5T_NATIVE_DOUBLE,
                                                           H5T_FLOAT, "floating-point numbers");
  if (!std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); })) {
    impl_->refuse(dataset, "expected finite numbers, found NaN or infinity");
  }
  const std::string found = string_attribute(dataset, "units");
  if (found != unit) {
    impl_->refuse(dataset, "expected the unit '" + std::string(unit) + "', found '" + found + "'");
  }
  return values;
}

std::vector<std::int32_t> Hdf5Reader::read_integers(const std::string& dataset,
                                                    const Shape& expected) const {
  return impl_->read_numbers<std::int32_t>(dataset, expected, H5T_NATIVE_INT32, H5T_INTEGER,
                                           "integers");
}

std::vector<std::string> Hdf5Reader::read_strings(const std::string& dataset) const {
  const Hdf5Handle type = hdf5_string_type();
  std::vector<char*> texts =
      impl_->read_numbers<char*>(dataset, {kAnyExtent}, type.get(), H5T_STRING, "strings");
  std::vector<std::string> values(texts.begin(), texts.end());
  for (char* text : texts) H5free_memory(text);
  return values;
}

std::string Hdf5Reader::string_attribute(const std::string& object, const std::string& name) const {
  const Hdf5Handle attribute = impl_->open_attribute(object, name, H5T_STRING, "string");
  const Hdf5Handle stored(H5Aget_type(attribute.get()), H5Tclose);
  if (H5Tis_variable_str(stored.get()) <= 0) {
    impl_->refuse(object, "expected the attribute '" + name + "' to be a variable-length string");
  }
  const Hdf5Handle type = hdf5_string_type();
  char* text = nullptr;
  if (H5Aread(attribute.get(), type.get(), &text) < 0 || text == nullptr) {
    impl_->refuse(object, "the attribute '" + name + "' cannot be read");
  }
  std::string value(text);
  H5free_memory(text);
  return value;
}

double Hdf5Reader::double_attribute(const std::string& object, const std::string& name) const {
  const Hdf5Handle attribute = impl_->open_attribute(object, name, H5T_FLOAT, "number");
  double value = 0;
  if (H5Aread(attribute.get(), H5T_NATIVE_DOUBLE, &value) < 0 || !std::isfinite(value)) {
    impl_->refuse(object, "expected a finite number as attribute '" + name + "'");
  }
  return value;
}

std::int64_t Hdf5Reader::integer_attribute(const std::string& object,
                                           const std::string& name) const {
  const Hdf5Handle attribute = impl_->open_attribute(object, name, H5T_INTEGER, "integer");
  std::int64_t value = 0;
  if (H5Aread(attribute.get(), H5T_NATIVE_INT64, &value) < 0) {
    impl_->refuse(object, "the attribute '" + name + "' cannot be read");
  }
  return value;
}

void Hdf5Reader::refuse(const std::string& object, const std::string& problem) const {
  impl_->refuse(object, problem);
}

}  // namespace flexneck
