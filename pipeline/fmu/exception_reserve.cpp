// SPDX-License-Identifier: GPL-3.0-or-later
// Of the shared object that has libstdc++ in itself.

// Its reserve for exceptions, which libstdc++ keeps to the end of a process.
// NOLINTBEGIN(bugprone-reserved-identifier): the library's own names
namespace __gnu_cxx {
void __freeres();
}
// NOLINTEND(bugprone-reserved-identifier)

namespace {

/// Behind all other destructors of the shared object, which may be loaded again and again.
__attribute__((destructor(101))) void free_reserve() { __gnu_cxx::__freeres(); }

}  // namespace
