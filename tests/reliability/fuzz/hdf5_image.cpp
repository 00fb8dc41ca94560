// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/reliability/fuzz/hdf5_image.h"

#include <utility>

#include "geometry/foundation/error.h"

namespace flexneck::fuzz {

using Handle = Hdf5Handle;

namespace {

Handle in_memory() {
  Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_fapl_core(access.get(), 1 << 16, false);
  return access;
}

}  // namespace

Handle opened_image(const std::string& image) {
  const Handle access = in_memory();
  H5Pset_file_image(access.get(), const_cast<char*>(image.data()), image.size());
  Handle file(H5Fopen("image", H5F_ACC_RDWR, access.get()), H5Fclose);
  if (!file) throw ComputationError("the image of a sound file cannot be opened");
  return file;
}

std::string image_of(const Handle& file) {
  H5Fflush(file.get(), H5F_SCOPE_GLOBAL);
  std::string image(static_cast<std::size_t>(H5Fget_file_image(file.get(), nullptr, 0)), '\0');
  H5Fget_file_image(file.get(), image.data(), image.size());
  return image;
}

Handle opened_object(hid_t file, const std::string& path) {
  return {H5Oopen(file, path.c_str(), H5P_DEFAULT), H5Oclose};
}

std::vector<std::string> attributes_of(hid_t object) {
  std::vector<std::string> names;
  H5Aiterate2(
      object, H5_INDEX_NAME, H5_ITER_INC, nullptr,
      [](hid_t, const char* name, const H5A_info_t*, void* list) -> herr_t {
        static_cast<std::vector<std::string>*>(list)->emplace_back(name);
        return 0;
      },
      &names);
  return names;
}

void copy_attributes(hid_t from, hid_t to) {
  for (const std::string& name : attributes_of(from)) {
    const Handle attribute(H5Aopen(from, name.c_str(), H5P_DEFAULT), H5Aclose);
    const Handle type(H5Aget_type(attribute.get()), H5Tclose);
    const Handle space(H5Aget_space(attribute.get()), H5Sclose);
    const hssize_t count = H5Sget_simple_extent_npoints(space.get());
    if (H5Tis_variable_str(type.get()) > 0 || count < 0) continue;
    std::string values(H5Tget_size(type.get()) * static_cast<std::size_t>(count), '\0');
    const Handle copy(
        H5Acreate2(to, name.c_str(), type.get(), space.get(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    if (!values.empty() && H5Aread(attribute.get(), type.get(), values.data()) >= 0)
      H5Awrite(copy.get(), type.get(), values.data());
  }
}

std::string without_hash(const std::string& sound) {
  const Handle from = opened_image(sound);
  const Handle to(H5Fcreate("fresh", H5F_ACC_TRUNC, H5P_DEFAULT, in_memory().get()), H5Fclose);
  copy_attributes(from.get(), to.get());
  const std::pair<hid_t, hid_t> files{from.get(), to.get()};
  H5Literate(
      from.get(), H5_INDEX_NAME, H5_ITER_INC, nullptr,
      [](hid_t, const char* name, const H5L_info_t*, void* data) {
        const auto& [source, target] = *static_cast<const std::pair<hid_t, hid_t>*>(data);
        return H5Ocopy(source, name, target, name, H5P_DEFAULT, H5P_DEFAULT);
      },
      const_cast<std::pair<hid_t, hid_t>*>(&files));
  return image_of(to);
}

}  // namespace flexneck::fuzz
