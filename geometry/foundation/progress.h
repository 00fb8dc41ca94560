// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>

namespace flexneck {

/// Callback by which a stage reports its progress: one line without a line break per call. May be
/// empty.
using Progress = std::function<void(const std::string&)>;

}  // namespace flexneck
