// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/reliability/fuzz/hdf5_edits.h"

#include <set>

#include "tests/reliability/fuzz/hdf5_choices.h"
#include "tests/reliability/fuzz/hdf5_image.h"

namespace flexneck::fuzz {

namespace {

using Handle = Hdf5Handle;

constexpr hsize_t kMaxValues = 4096;  ///< limit of datasets that an edit creates

std::string folder_of(const std::string& path) { return path.substr(0, path.rfind('/') + 1); }
std::string last_of(const std::string& path) { return path.substr(path.rfind('/') + 1); }

/// Values of a dataset that is about to be recreated, as far as they can be converted to another
/// type: numbers as doubles.
struct Kept {
  explicit Kept(const Handle& dataset)
      : type(H5Dget_type(dataset.get()), H5Tclose),
        extents(extents_of(Handle(H5Dget_space(dataset.get()), H5Sclose))) {
    const H5T_class_t kind = H5Tget_class(type.get());
    const bool is_number = kind == H5T_FLOAT || kind == H5T_INTEGER;
    if (is_number) type = Handle(H5Tcopy(H5T_NATIVE_DOUBLE), H5Tclose);
    size = H5Tget_size(type.get());
    if ((!is_number && kind != H5T_STRING) || H5Tis_variable_str(type.get()) > 0 ||
        count_of(extents) > kMaxValues) {
      return;
    }
    bytes.resize(size * count_of(extents));
    if (!bytes.empty())
      H5Dread(dataset.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data());
  }
  /// Writes the values, repeated as often as needed.
  void write(hid_t dataset, hsize_t count) const {
    if (bytes.empty() || count == 0) return;
    std::string values;
    while (values.size() < size * count) values += bytes;
    H5Dwrite(dataset, type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
  }

  Handle type;
  Extents extents;
  std::size_t size = 0;
  std::string bytes;
};

/// The file and script of an edit.
struct Edit {
  hid_t file;
  const std::vector<std::string>& objects;
  const std::vector<std::string>& names;
  EditScript& script;

  const std::string& any_object() const { return script.among(objects); }
  Handle any_dataset(std::string& path) const {
    path = any_object();
    return {H5Dopen2(file, path.c_str(), H5P_DEFAULT), H5Dclose};
  }
  /// A new name beside an object, or the name of an existing object.
  std::string any_place(const std::string& beside) const {
    return script.below(4) == 0 ? any_object() : folder_of(beside) + script.text(names);
  }
};

/// Recreates a dataset with its values and attributes.
void make_anew(const Edit& edit, const std::string& path, const Handle& dataset, const Handle& type,
               const Extents& extents, const Handle& creation, bool is_written) {
  if (count_of(extents) > kMaxValues) return;
  const Kept kept(dataset);
  const std::string old = path + " before";
  if (H5Lmove(edit.file, path.c_str(), edit.file, old.c_str(), H5P_DEFAULT, H5P_DEFAULT) < 0)
    return;
  const Handle fresh(H5Dcreate2(edit.file, path.c_str(), type.get(), space_of(extents).get(),
                                H5P_DEFAULT, creation.get(), H5P_DEFAULT),
                     H5Dclose);
  if (fresh) {
    if (is_written && can_be_written(creation)) kept.write(fresh.get(), count_of(extents));
    copy_attributes(dataset.get(), fresh.get());
  }
  H5Ldelete(edit.file, old.c_str(), H5P_DEFAULT);
}

/// Changes one value of a dataset.
void change_value(const Edit& edit) {
  std::string path;
  const Handle dataset = edit.any_dataset(path);
  if (!dataset) return;
  const Handle space(H5Dget_space(dataset.get()), H5Sclose);
  const Extents extents = extents_of(space);
  if (extents.empty() || count_of(extents) == 0) return;
  if (!can_be_written(Handle(H5Dget_create_plist(dataset.get()), H5Pclose))) return;
  Extents place;
  for (const hsize_t extent : extents)
    place.push_back(edit.script.below(static_cast<std::size_t>(extent)));
  H5Sselect_elements(space.get(), H5S_SELECT_SET, 1, place.data());
  const Handle one = space_of({1});
  const Handle type(H5Dget_type(dataset.get()), H5Tclose);
  const auto write = [&](hid_t in_memory_type, const void* value) {
    H5Dwrite(dataset.get(), in_memory_type, one.get(), space.get(), H5P_DEFAULT, value);
  };
  if (H5Tget_class(type.get()) == H5T_FLOAT) {
    const double value = edit.script.real();
    write(H5T_NATIVE_DOUBLE, &value);
  } else if (H5Tget_class(type.get()) == H5T_INTEGER) {
    const std::int64_t value = edit.script.integer();
    write(H5T_NATIVE_INT64, &value);
  } else if (H5Tget_class(type.get()) == H5T_STRING && H5Tis_variable_str(type.get()) == 0) {
    std::string value = edit.script.text(edit.names);
    value.resize(H5Tget_size(type.get()));
    write(type.get(), value.data());
  }
}

void change_extents(const Edit& edit) {
  std::string path;
  const Handle dataset = edit.any_dataset(path);
  if (!dataset) return;
  Extents extents = extents_of(Handle(H5Dget_space(dataset.get()), H5Sclose));
  switch (edit.script.below(5)) {
    case 0:
      extents.push_back(1 + edit.script.below(3));
      break;
    case 1:
      if (!extents.empty()) extents.pop_back();
      break;
    case 2:
      extents = {count_of(extents)};
      break;
    default:
      if (!extents.empty()) extents[edit.script.below(extents.size())] = edit.script.byte() % 12;
  }
  const Handle type(H5Dget_type(dataset.get()), H5Tclose);
  make_anew(edit, path, dataset, type, extents, Handle(H5Pcreate(H5P_DATASET_CREATE), H5Pclose),
            true);
}

void change_type(const Edit& edit) {
  std::string path;
  const Handle dataset = edit.any_dataset(path);
  if (!dataset) return;
  make_anew(edit, path, dataset, any_type(edit.script),
            extents_of(Handle(H5Dget_space(dataset.get()), H5Sclose)),
            Handle(H5Pcreate(H5P_DATASET_CREATE), H5Pclose), true);
}

void change_layout(const Edit& edit) {
  std::string path;
  const Handle dataset = edit.any_dataset(path);
  if (!dataset) return;
  const Extents extents = extents_of(Handle(H5Dget_space(dataset.get()), H5Sclose));
  const Handle type(H5Dget_type(dataset.get()), H5Tclose);
  const bool is_written = edit.script.below(8) != 0;
  make_anew(edit, path, dataset, type, extents, any_layout(edit.script, extents), is_written);
}

void remove(const Edit& edit) { H5Ldelete(edit.file, edit.any_object().c_str(), H5P_DEFAULT); }

void move(const Edit& edit) {
  const std::string from = edit.any_object();
  const std::string to = edit.any_place(from);
  H5Lmove(edit.file, from.c_str(), edit.file, to.c_str(), H5P_DEFAULT, H5P_DEFAULT);
}

void swap(const Edit& edit) {
  const std::string a = edit.any_object();
  const std::string b = edit.any_object();
  if (a == b) return;
  const auto rename = [&](const std::string& from, const std::string& to) {
    return H5Lmove(edit.file, from.c_str(), edit.file, to.c_str(), H5P_DEFAULT, H5P_DEFAULT);
  };
  if (rename(a, "/swapped") >= 0 && rename(b, a) >= 0) rename("/swapped", b);
}

void copy(const Edit& edit) {
  const std::string from = edit.any_object();
  const std::string to = edit.any_place(from);
  H5Ocopy(edit.file, from.c_str(), edit.file, to.c_str(), H5P_DEFAULT, H5P_DEFAULT);
}

/// Replaces an object by a link: to itself, to another one, to a group above it, to nothing, to
/// elsewhere.
void link(const Edit& edit) {
  const std::string at = edit.any_object();
  const std::string to = edit.any_place(at);
  if (edit.script.below(2) == 0) H5Ldelete(edit.file, at.c_str(), H5P_DEFAULT);
  switch (edit.script.below(3)) {
    case 0:
      H5Lcreate_soft(to.c_str(), edit.file, at.c_str(), H5P_DEFAULT, H5P_DEFAULT);
      break;
    case 1:
      H5Lcreate_external("sound.h5", to.c_str(), edit.file, at.c_str(), H5P_DEFAULT, H5P_DEFAULT);
      break;
    default:
      H5Lcreate_hard(edit.file, to.c_str(), edit.file, at.c_str(), H5P_DEFAULT, H5P_DEFAULT);
  }
}

void make_group(const Edit& edit) {
  const std::string place = edit.any_place(edit.any_object());
  const Handle group(H5Gcreate2(edit.file, place.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                     H5Gclose);
}

/// Creates a named type, where readers expect a group or dataset.
void make_type(const Edit& edit) {
  const std::string place = edit.any_place(edit.any_object());
  const Handle type = any_type(edit.script);
  H5Tcommit2(edit.file, place.c_str(), type.get(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
}

/// The name of an attribute of an object, or another one.
std::string any_attribute(const Edit& edit, const Handle& object) {
  const std::vector<std::string> names = attributes_of(object.get());
  return names.empty() || edit.script.below(8) == 0 ? edit.script.text(edit.names)
                                                    : edit.script.among(names);
}

void remove_attribute(const Edit& edit) {
  const Handle object = opened_object(edit.file, edit.any_object());
  if (object) H5Adelete(object.get(), any_attribute(edit, object).c_str());
}

void rename_attribute(const Edit& edit) {
  const Handle object = opened_object(edit.file, edit.any_object());
  if (!object) return;
  const std::string from = any_attribute(edit, object);
  H5Arename(object.get(), from.c_str(), edit.script.text(edit.names).c_str());
}

void write_attribute(const Edit& edit, const Handle& attribute, const Handle& type) {
  switch (H5Tget_class(type.get())) {
    case H5T_INTEGER: {
      const std::int64_t value[] = {edit.script.integer(), 1};
      H5Awrite(attribute.get(), H5T_NATIVE_INT64, value);
      break;
    }
    case H5T_FLOAT: {
      const double value[] = {edit.script.real(), 1};
      H5Awrite(attribute.get(), H5T_NATIVE_DOUBLE, value);
      break;
    }
    case H5T_STRING: {
      std::string text = edit.script.text(edit.names);
      const char* const texts[] = {text.c_str(), nullptr};
      const bool is_variable = H5Tis_variable_str(type.get()) > 0;
      if (!is_variable) text.resize(2 * H5Tget_size(type.get()));
      if (edit.script.below(8) == 0 && is_variable) break;  // none was ever written
      H5Awrite(attribute.get(), type.get(),
               is_variable ? static_cast<const void*>(texts) : text.data());
      break;
    }
    default:
      break;
  }
}

/// Changes an attribute's value, most often keeping its type.
void change_attribute(const Edit& edit) {
  const Handle object = opened_object(edit.file, edit.any_object());
  if (!object) return;
  const std::string name = any_attribute(edit, object);
  Handle type = any_type(edit.script);
  if (edit.script.below(4) != 0) {
    const Handle before(H5Aopen(object.get(), name.c_str(), H5P_DEFAULT), H5Aclose);
    if (before) type = Handle(H5Aget_type(before.get()), H5Tclose);
  }
  H5Adelete(object.get(), name.c_str());
  const std::size_t kind = edit.script.below(16);
  const Handle space = kind == 0   ? Handle(H5Screate(H5S_NULL), H5Sclose)
                       : kind == 1 ? space_of({2})
                       : kind == 2 ? space_of({1})
                                   : Handle(H5Screate(H5S_SCALAR), H5Sclose);
  const Handle attribute(
      H5Acreate2(object.get(), name.c_str(), type.get(), space.get(), H5P_DEFAULT, H5P_DEFAULT),
      H5Aclose);
  if (attribute && kind != 0) write_attribute(edit, attribute, type);
}

constexpr std::array kEdits = {change_value,
                               change_value,
                               change_value,
                               change_attribute,
                               change_attribute,
                               change_extents,
                               change_type,
                               change_layout,
                               remove,
                               move,
                               swap,
                               copy,
                               link,
                               make_group,
                               remove_attribute,
                               rename_attribute,
                               make_type};

struct Found {
  std::vector<std::string> objects;
  std::set<std::string> names;
};

Found found_in(const Handle& file) {
  Found found;
  H5Ovisit2(
      file.get(), H5_INDEX_NAME, H5_ITER_INC,
      [](hid_t root, const char* name, const H5O_info_t*, void* data) -> herr_t {
        auto& all = *static_cast<Found*>(data);
        const std::string path = name == std::string(".") ? "/" : "/" + std::string(name);
        all.objects.push_back(path);
        if (path != "/") all.names.insert(last_of(path));
        for (const std::string& each : attributes_of(opened_object(root, path).get()))
          all.names.insert(each);
        return 0;
      },
      &found, H5O_INFO_BASIC);
  return found;
}

}  // namespace

Hdf5Edits::Hdf5Edits(const std::string& sound) {
  start_hdf5();
  // HDF5 keeps freed memory, otherwise each file allocates a megabyte anew.
  H5set_free_list_limits(-1, -1, -1, -1, -1, -1);
  image_ = without_hash(sound);
  const Found found = found_in(opened_image(image_));
  objects_ = found.objects;
  names_.assign(found.names.begin(), found.names.end());
  for (const char* const odd : {"", ".", "..", "a", "a/b", "x y", "\x1b[31m", "\xff", "\xc3\xa9",
                                "1", "-1", "1/m", "hex8", "tet10", "quad4", "rigid", "normal"}) {
    names_.emplace_back(odd);
  }
  names_.emplace_back(300, 'n');
}

std::string Hdf5Edits::edited(EditScript& script) const {
  constexpr int kMaxEdits = 12;
  const Handle file = opened_image(image_);
  const Edit edit{file.get(), objects_, names_, script};
  for (int k = 0; k < kMaxEdits && !script.is_done(); ++k) script.among(kEdits)(edit);
  return image_of(file);
}

}  // namespace flexneck::fuzz
