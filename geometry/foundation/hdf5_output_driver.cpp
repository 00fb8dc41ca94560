// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/foundation/hdf5_output_driver.h"

#include <algorithm>
#include <memory>
#include <new>

#include "geometry/foundation/atomic_file.h"

namespace flexneck {

namespace {

/// Driver information in the access properties, copied by HDF5.
struct AccessInfo {
  AtomicFile* file;
};

/// The driver's data of an open file; `base`, HDF5's own part, must come first.
struct OpenFile {
  H5FD_t base;
  AtomicFile* file;
  haddr_t allocated;  ///< "end of allocation", set by HDF5
  haddr_t size;
};

OpenFile& ours(H5FD_t* file) { return *reinterpret_cast<OpenFile*>(file); }
const OpenFile& ours(const H5FD_t* file) { return *reinterpret_cast<const OpenFile*>(file); }

H5FD_t* open(const char* /*name*/, unsigned /*flags*/, hid_t access, haddr_t /*max_address*/) {
  const auto* const info = static_cast<const AccessInfo*>(H5Pget_driver_info(access));
  if (info == nullptr) return nullptr;
  auto file = std::unique_ptr<OpenFile>(new (std::nothrow) OpenFile{});
  if (!file) return nullptr;
  file->file = info->file;
  return &file.release()->base;
}

herr_t close(H5FD_t* file) {
  const std::unique_ptr<OpenFile> last(&ours(file));
  return 0;
}

herr_t query(const H5FD_t* /*file*/, unsigned long* flags) {
  *flags = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_DATA_SIEVE |
           H5FD_FEAT_AGGREGATE_SMALLDATA | H5FD_FEAT_DEFAULT_VFD_COMPATIBLE;
  return 0;
}

haddr_t get_allocated(const H5FD_t* file, H5FD_mem_t /*kind*/) { return ours(file).allocated; }

herr_t set_allocated(H5FD_t* file, H5FD_mem_t /*kind*/, haddr_t end) {
  ours(file).allocated = end;
  return 0;
}

haddr_t get_size(const H5FD_t* file, H5FD_mem_t /*kind*/) { return ours(file).size; }

herr_t read(H5FD_t* file, H5FD_mem_t /*kind*/, hid_t /*transfer*/, haddr_t place, std::size_t size,
            void* block) {
  ours(file).file->read_at(place, {static_cast<char*>(block), size});
  return 0;
}

herr_t write(H5FD_t* file, H5FD_mem_t /*kind*/, hid_t /*transfer*/, haddr_t place, std::size_t size,
             const void* block) {
  ours(file).file->write_at(place, {static_cast<const char*>(block), size});
  ours(file).size = std::max(ours(file).size, place + size);
  return 0;
}

/// HDF5 calls it before it closes a file: the size must equal the "end of allocation".
herr_t truncate(H5FD_t* file, hid_t /*transfer*/, hbool_t /*closing*/) {
  if (ours(file).size != ours(file).allocated) ours(file).file->resize(ours(file).allocated);
  ours(file).size = ours(file).allocated;
  return 0;
}

H5FD_class_t driver() {
  H5FD_class_t driver{};
#ifdef H5FD_CLASS_VERSION  // since HDF5 1.14
  driver.version = H5FD_CLASS_VERSION;
  driver.value = H5_VFD_RESERVED;  // the first number that is none of the library's own drivers
#endif
  driver.name = "flexneck output";
  driver.maxaddr = static_cast<haddr_t>(1) << 62U;
  driver.fc_degree = H5F_CLOSE_STRONG;
  driver.fapl_size = sizeof(AccessInfo);
  driver.open = open;
  driver.close = close;
  driver.query = query;
  driver.get_eoa = get_allocated;
  driver.set_eoa = set_allocated;
  driver.get_eof = get_size;
  driver.read = read;
  driver.write = write;
  driver.truncate = truncate;
  std::fill_n(driver.fl_map, H5FD_MEM_NTYPES, H5FD_MEM_DEFAULT);
  return driver;
}

}  // namespace

Hdf5Handle output_access(AtomicFile& file) {
  Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  // The driver stays registered until the library ends: H5Fclose still reads it after it has
  // released the file's reference to it, which must not be the last one.
  static const hid_t id = [] {
    const H5FD_class_t description = driver();
    return H5FDregister(&description);
  }();
  const AccessInfo info{&file};
  if (H5Pset_driver(access.get(), id, &info) < 0) return {};
  return access;
}

}  // namespace flexneck
