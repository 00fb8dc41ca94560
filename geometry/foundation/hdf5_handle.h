// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Plain names mean the structures of HDF5 1.10 in later versions, too.
#define H5_USE_110_API
#include <hdf5.h>
#include <string>
#include <utility>

namespace flexneck {

/// Owns one HDF5 identifier. Private to the reader and the writer: hdf5.h includes mpi.h.
class Hdf5Handle {
 public:
  using Closer = herr_t (*)(hid_t);

  Hdf5Handle() = default;
  Hdf5Handle(hid_t id, Closer closer) : id_(id), closer_(closer) {}
  ~Hdf5Handle() { reset(); }
  Hdf5Handle(const Hdf5Handle&) = delete;
  Hdf5Handle& operator=(const Hdf5Handle&) = delete;
  Hdf5Handle(Hdf5Handle&& other) noexcept
      : id_(std::exchange(other.id_, H5I_INVALID_HID)), closer_(other.closer_) {}
  Hdf5Handle& operator=(Hdf5Handle&& other) noexcept {
    if (this != &other) {
      reset();
      id_ = std::exchange(other.id_, H5I_INVALID_HID);
      closer_ = other.closer_;
    }
    return *this;
  }

  void reset() { close(); }
  /// @return false if HDF5 could not close it; the identifier is invalid either way
  bool close() { return id_ < 0 || closer_(std::exchange(id_, H5I_INVALID_HID)) >= 0; }
  explicit operator bool() const { return id_ >= 0; }
  hid_t get() const { return id_; }

 private:
  hid_t id_ = H5I_INVALID_HID;
  Closer closer_ = nullptr;
};

/// Must be called before any other function of HDF5. HDF5 then prints no errors to the console
/// (they become exceptions of this library), loads no plug-ins and does nothing at the end of the
/// process, where it crashes if a file could not be closed.
inline void start_hdf5() {
  H5dont_atexit();
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  H5PLset_loading_state(0);
}

}  // namespace flexneck
