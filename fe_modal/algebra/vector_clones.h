// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// Before a function: it is compiled for each width of vector units, and when the program is loaded
/// it takes what the processor has. What the function calls must be inline to be compiled so too.
/// Only for loops of plain numbers: Eigen chooses its vectors before the compiler does, at two
/// numbers each. Not under a sanitizer, before whose start the choice would be made, and so not by
/// clang, which builds the fuzzers.
#if defined(__x86_64__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) && \
    !defined(__clang__)
#define FLEXNECK_VECTOR_CLONES [[gnu::target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")]]
#else
#define FLEXNECK_VECTOR_CLONES
#endif
