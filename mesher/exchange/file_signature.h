// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

#include "mesher/exchange/foreign_file.h"

namespace flexneck::mesher {

/// Returns why the contents are no file of this format: their beginning or, where the format has
/// one, their structure is wrong. Empty text if they are sound.
std::string signature_problem(ForeignFormat format, std::string_view contents);

}  // namespace flexneck::mesher
