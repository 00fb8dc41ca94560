# SPDX-License-Identifier: GPL-3.0-or-later
# flexneck::warnings: every target of the project links it privately; it is not installed.
add_library(flexneck_warnings INTERFACE)
add_library(flexneck::warnings ALIAS flexneck_warnings)
# GCC 12 sees overlapping copies in plain string concatenation (GCC bug 105651), and with precompiled
# headers, where it inlines more of it, copies from and to beyond the end. GCC 13 and 14 take any reference that
# a function returns for one to a temporary that it was given.
target_compile_options(
  flexneck_warnings
  INTERFACE
    "$<BUILD_INTERFACE:-Wall;-Wextra;-Wpedantic;-Wconversion;-Wshadow>"
    $<BUILD_INTERFACE:$<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>>
    "$<BUILD_INTERFACE:$<$<AND:$<CXX_COMPILER_ID:GNU>,$<VERSION_GREATER_EQUAL:$<CXX_COMPILER_VERSION>,13>>:-Wno-dangling-reference>>"
    "$<BUILD_INTERFACE:$<$<AND:$<CXX_COMPILER_ID:GNU>,$<BOOL:${FLEXNECK_PRECOMPILED_HEADERS}>>:-Wno-stringop-overflow;-Wno-stringop-overread;-Wno-array-bounds>>"
    $<BUILD_INTERFACE:$<$<BOOL:${FLEXNECK_WARNINGS_AS_ERRORS}>:-Werror>>)
