// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/reliability/fuzz/hdf5_choices.h"

#include <algorithm>
#include <array>
#include <functional>
#include <numeric>

namespace flexneck::fuzz {

using Handle = Hdf5Handle;

Extents extents_of(const Handle& space) {
  Extents extents(static_cast<std::size_t>(std::max(0, H5Sget_simple_extent_ndims(space.get()))));
  H5Sget_simple_extent_dims(space.get(), extents.data(), nullptr);
  return extents;
}

hsize_t count_of(const Extents& extents) {
  return std::accumulate(extents.begin(), extents.end(), hsize_t{1}, std::multiplies<>());
}

Handle space_of(const Extents& extents) {
  return {H5Screate_simple(static_cast<int>(extents.size()), extents.data(), nullptr), H5Sclose};
}

namespace {

Handle compound_type() {
  Handle type(H5Tcreate(H5T_COMPOUND, 16), H5Tclose);
  H5Tinsert(type.get(), "r", 0, H5T_IEEE_F64LE);
  H5Tinsert(type.get(), "i", 8, H5T_IEEE_F64LE);
  return type;
}

Handle enumeration_type() {
  Handle type(H5Tenum_create(H5T_STD_I8LE), H5Tclose);
  const std::int8_t values[] = {0, 1};
  H5Tenum_insert(type.get(), "FALSE", &values[0]);
  H5Tenum_insert(type.get(), "TRUE", &values[1]);
  return type;
}

Handle string_type(std::size_t length, EditScript& script) {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type.get(), length);
  H5Tset_strpad(type.get(),
                script.among(std::array{H5T_STR_NULLTERM, H5T_STR_NULLPAD, H5T_STR_SPACEPAD}));
  H5Tset_cset(type.get(), script.among(std::array{H5T_CSET_ASCII, H5T_CSET_UTF8}));
  return type;
}

}  // namespace

Handle any_type(EditScript& script) {
  const std::array kPlain = {H5T_IEEE_F64LE, H5T_IEEE_F32LE, H5T_IEEE_F64BE, H5T_NATIVE_LDOUBLE,
                             H5T_STD_I8LE,   H5T_STD_U8BE,   H5T_STD_I32BE,  H5T_STD_I64LE,
                             H5T_STD_U64LE,  H5T_STD_U32LE,  H5T_STD_B32LE,  H5T_STD_REF_OBJ};
  const std::size_t choice = script.below(kPlain.size() + 6);
  if (choice < kPlain.size()) return {H5Tcopy(kPlain[choice]), H5Tclose};
  const hsize_t three = 3;
  switch (choice - kPlain.size()) {
    case 0:
      return string_type(1 + script.below(40), script);
    case 1:
      return string_type(H5T_VARIABLE, script);
    case 2:
      return compound_type();
    case 3:
      return enumeration_type();
    case 4:
      return {H5Tvlen_create(H5T_IEEE_F64LE), H5Tclose};
    default:
      return {H5Tarray_create2(H5T_IEEE_F64LE, 1, &three), H5Tclose};
  }
}

Handle any_layout(EditScript& script, const Extents& extents) {
  Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  switch (script.below(6)) {
    case 0:
      return creation;
    case 1:
      H5Pset_layout(creation.get(), H5D_COMPACT);
      return creation;
    case 2:
      H5Pset_external(creation.get(), "/etc/hostname", 0, H5F_UNLIMITED);
      return creation;
    default:
      break;
  }
  if (extents.empty()) return creation;
  Extents chunk = extents;
  for (hsize_t& extent : chunk)
    extent = 1 + script.below(static_cast<std::size_t>(std::max<hsize_t>(extent, 1)));
  H5Pset_chunk(creation.get(), static_cast<int>(chunk.size()), chunk.data());
  for (std::size_t filters = script.below(4); filters > 0; --filters) {
    switch (script.below(5)) {
      case 0:
        H5Pset_deflate(creation.get(), static_cast<unsigned>(script.below(10)));
        break;
      case 1:
        H5Pset_shuffle(creation.get());
        break;
      case 2:
        H5Pset_fletcher32(creation.get());
        break;
      case 3:
        H5Pset_nbit(creation.get());
        break;
      default:
        H5Pset_scaleoffset(creation.get(), H5Z_SO_INT, 2);
    }
  }
  return creation;
}

bool can_be_written(const Handle& creation) {
  const auto has = [&](H5Z_filter_t filter) {
    std::size_t values = 0;
    return H5Pget_filter_by_id2(creation.get(), filter, nullptr, &values, nullptr, 0, nullptr,
                                nullptr) >= 0;
  };
  return !has(H5Z_FILTER_NBIT) && !has(H5Z_FILTER_SCALEOFFSET);
}

}  // namespace flexneck::fuzz
