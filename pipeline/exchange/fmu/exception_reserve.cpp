// SPDX-License-Identifier: GPL-3.0-or-later
// Part of the shared object that contains libstdc++.

// __gnu_cxx::__freeres() of libstdc++, which frees a reserve for exceptions that is otherwise kept
// to the end of the process.
void free_reserve_of_exceptions() __asm__("_ZN9__gnu_cxx9__freeresEv");

namespace {

/// Frees the reserve after all other destructors of the shared object, which may be loaded
/// repeatedly.
__attribute__((destructor(101))) void free_reserve() { free_reserve_of_exceptions(); }

}  // namespace
