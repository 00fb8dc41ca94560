// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/reliability/fuzz/hdf5_target.h"

#include "geometry/foundation/hdf5_file.h"
#include "geometry/foundation/input_file.h"

namespace flexneck::fuzz {

namespace {

std::string sound_bytes(const InputFolder& folder, const Hdf5Target::OnPath& write_sound) {
  const std::filesystem::path path = folder.path() / "sound.h5";
  write_sound(path);
  return text_of_file(path);
}

}  // namespace

Hdf5Target::Hdf5Target(const OnPath& write_sound) : edits_(sound_bytes(folder_, write_sound)) {}

int Hdf5Target::run(const std::uint8_t* data, std::size_t size, const OnPath& read) const {
  EditScript script(data, size);
  const std::filesystem::path path = folder_.with("edited.h5", edits_.edited(script));
  try_reader([&] { static_cast<void>(format_of(path)); });
  return try_reader([&] { read(path); });
}

}  // namespace flexneck::fuzz
