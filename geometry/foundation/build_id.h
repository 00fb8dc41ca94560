// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace flexneck {

/// Identifier of the build of the running program, or of the shared object that this code is a part
/// of: its GNU build id (note NT_GNU_BUILD_ID of the ELF file) in hexadecimal digits, which the
/// linker computes from its inputs. Installing and stripping change the file but not the build id.
/// A program linked without one has the hash of its file instead.
std::string build_id();

}  // namespace flexneck
