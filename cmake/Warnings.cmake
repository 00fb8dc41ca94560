# SPDX-License-Identifier: GPL-3.0-or-later
# flexneck::warnings: linked privately by every target of ours.
add_library(flexneck_warnings INTERFACE)
add_library(flexneck::warnings ALIAS flexneck_warnings)
# GCC 12 sees overlapping copies in plain string concatenation (GCC bug 105651).
target_compile_options(
  flexneck_warnings INTERFACE -Wall -Wextra -Wpedantic -Wconversion -Wshadow
                              $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>
                              $<$<BOOL:${FLEXNECK_WARNINGS_AS_ERRORS}>:-Werror>)
