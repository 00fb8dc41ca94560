// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/foundation/running_object.h"

#include <dlfcn.h>
#include <link.h>

namespace flexneck {

namespace fs = std::filesystem;

namespace {

/// An address in this object; any other would do.
const char kHere = 0;

/// The loader's name of this object; empty for the program itself.
std::string loaded_name() {
  Dl_info info{};
  link_map* map = nullptr;
  void* const place = &map;  // dladdr1 wants the address of a pointer to anything
  if (dladdr1(&kHere, &info, static_cast<void**>(place), RTLD_DL_LINKMAP) == 0 || map == nullptr)
    return {};
  return map->l_name;
}

}  // namespace

bool runs_as_program() { return loaded_name().empty(); }

fs::path running_object() {
  const std::string name = loaded_name();
  return name.empty() ? fs::read_symlink("/proc/self/exe") : fs::canonical(name);
}

}  // namespace flexneck
