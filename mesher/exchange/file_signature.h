// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

#include "mesher/exchange/foreign_file.h"

namespace flexneck::mesher {

/// What is wrong with the contents of a file of this format, or an empty text if they begin, and as
/// far as a format has one are built, as they must.
std::string signature_problem(ForeignFormat format, std::string_view contents);

}  // namespace flexneck::mesher
