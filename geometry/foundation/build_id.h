// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace flexneck {

/// What tells the running program, or the shared object that this is a part of, from that of
/// another build: its GNU build id (note NT_GNU_BUILD_ID of the ELF file) in hexadecimal digits,
/// which the linker makes of what it links. Installing and stripping, which change the file, leave
/// it as it is. Of a program that was linked without one, the hash of its file.
std::string build_id();

}  // namespace flexneck
