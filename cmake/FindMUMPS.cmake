# SPDX-License-Identifier: GPL-3.0-or-later
# MUMPS::MUMPS: real, double, with MPI. Debian's MUMPS has no CMake configuration of its own.
find_path(MUMPS_INCLUDE_DIR dmumps_c.h)
find_library(MUMPS_LIBRARY dmumps)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(MUMPS REQUIRED_VARS MUMPS_LIBRARY MUMPS_INCLUDE_DIR)
if(MUMPS_FOUND AND NOT TARGET MUMPS::MUMPS)
  add_library(MUMPS::MUMPS UNKNOWN IMPORTED)
  set_target_properties(
    MUMPS::MUMPS PROPERTIES IMPORTED_LOCATION "${MUMPS_LIBRARY}"
                            INTERFACE_SYSTEM_INCLUDE_DIRECTORIES "${MUMPS_INCLUDE_DIR}"
                            INTERFACE_INCLUDE_DIRECTORIES "${MUMPS_INCLUDE_DIR}")
endif()
