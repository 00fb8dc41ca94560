// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

namespace flexneck {

/// A text escaped for XML and HTML, between tags and in attributes: &, <, >, " and '.
std::string xml_text(std::string_view text);

}  // namespace flexneck
