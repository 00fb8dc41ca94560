# SPDX-License-Identifier: GPL-3.0-or-later
# Gmsh::Gmsh: Debian's gmsh has no CMake configuration of its own.
find_path(GMSH_INCLUDE_DIR gmsh.h)
find_library(GMSH_LIBRARY gmsh)
if(GMSH_INCLUDE_DIR)
  file(STRINGS "${GMSH_INCLUDE_DIR}/gmsh.h" Gmsh_VERSION REGEX "^#define GMSH_API_VERSION ")
  string(REGEX REPLACE ".*\"(.*)\".*" "\\1" Gmsh_VERSION "${Gmsh_VERSION}")
endif()
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(Gmsh REQUIRED_VARS GMSH_LIBRARY GMSH_INCLUDE_DIR
                                  VERSION_VAR Gmsh_VERSION)
if(Gmsh_FOUND AND NOT TARGET Gmsh::Gmsh)
  add_library(Gmsh::Gmsh UNKNOWN IMPORTED)
  set_target_properties(
    Gmsh::Gmsh PROPERTIES IMPORTED_LOCATION "${GMSH_LIBRARY}"
                          INTERFACE_SYSTEM_INCLUDE_DIRECTORIES "${GMSH_INCLUDE_DIR}"
                          INTERFACE_INCLUDE_DIRECTORIES "${GMSH_INCLUDE_DIR}")
endif()
