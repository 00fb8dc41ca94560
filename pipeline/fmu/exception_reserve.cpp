// SPDX-License-Identifier: GPL-3.0-or-later
// Of the shared object that has libstdc++ in itself.

// __gnu_cxx::__freeres() of libstdc++, whose reserve for exceptions it keeps to the end of a
// process.
void free_reserve_of_exceptions() __asm__("_ZN9__gnu_cxx9__freeresEv");

namespace {

/// Behind all other destructors of the shared object, which may be loaded again and again.
__attribute__((destructor(101))) void free_reserve() { free_reserve_of_exceptions(); }

}  // namespace
