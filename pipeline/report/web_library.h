// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace flexneck::pipeline {

/// A script that a Debian package installs for web pages.
enum class WebLibrary { d3, three };

/// Its source. @throws InputError with the package's name if it is not installed.
std::string source_of(WebLibrary library);

}  // namespace flexneck::pipeline
