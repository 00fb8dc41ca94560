// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>

namespace flexneck {

/// Calls work(0) … work(count - 1), each once, by as many threads at most, of which the caller is
/// one. @throws what the first of them throws, when all have ended; the rest is then left out.
void in_parallel(std::size_t count, unsigned threads, const std::function<void(std::size_t)>& work);

}  // namespace flexneck
