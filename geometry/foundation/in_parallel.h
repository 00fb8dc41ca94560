// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>

namespace flexneck {

/// Calls work(0) … work(count - 1), each once, on at most `threads` threads, the caller's included.
/// @throws what the first failing call throws, when all threads have ended; the rest is left out.
void in_parallel(std::size_t count, unsigned threads, const std::function<void(std::size_t)>& work);

}  // namespace flexneck
