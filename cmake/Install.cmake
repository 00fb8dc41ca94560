# SPDX-License-Identifier: GPL-3.0-or-later
# cmake --install: the command with its manual page, completion and shipped files; and, as component
# `development`, the libraries of the source folders with their headers, for find_package(flexneck)
# and pkg-config. No path of the prefix is stored, so the installed tree may be moved.
include(CMakePackageConfigHelpers)

set(flexneck_data "${CMAKE_INSTALL_DATADIR}/flexneck")
set(flexneck_headers "${CMAKE_INSTALL_INCLUDEDIR}/flexneck")
set(flexneck_config "${CMAKE_INSTALL_LIBDIR}/cmake/flexneck")

# The command.
install(TARGETS flexneck RUNTIME COMPONENT runtime)
# The folder is the same for every architecture: the program looks for it beside or above itself.
install(TARGETS flexneck_fmu flexneck_fmu_formulas LIBRARY DESTINATION lib/flexneck COMPONENT runtime)
install(TARGETS flexneck_mesher_program RUNTIME DESTINATION lib/flexneck COMPONENT runtime)
set(made "${PROJECT_BINARY_DIR}/generated/reference")
install(FILES "${made}/flexneck.1" DESTINATION "${CMAKE_INSTALL_MANDIR}/man1" COMPONENT runtime)
install(FILES "${made}/flexneck"
        DESTINATION "${CMAKE_INSTALL_DATADIR}/bash-completion/completions" COMPONENT runtime)
# Texts link to one another and to pictures: they lie as in the sources.
install(FILES README.md LICENSE DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT runtime)
install(DIRECTORY pipeline/manual DESTINATION "${CMAKE_INSTALL_DOCDIR}/pipeline" COMPONENT runtime
        FILES_MATCHING PATTERN "*.md" PATTERN "*.cff" PATTERN "manual/README.md" EXCLUDE)
install(DIRECTORY pipeline/data/pictures DESTINATION "${CMAKE_INSTALL_DOCDIR}/pipeline/data" COMPONENT runtime)

# Shipped files, laid out as in the sources: files name one another by these paths.
foreach(folder geometry geometry/examples pipeline/data/models pipeline/data/regulations pipeline/data/studies
               pipeline/data/studies/fits pipeline/data/verification)
  file(GLOB files CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/${folder}/*")
  list(FILTER files INCLUDE REGEX "\\.(toml|geo|csv|inp|msh)$")
  install(FILES ${files} DESTINATION "${flexneck_data}/${folder}" COMPONENT runtime)
endforeach()
install(FILES pipeline/exchange/fmu/muparser.txt DESTINATION "${flexneck_data}/pipeline/exchange/fmu" COMPONENT runtime)
install(DIRECTORY pipeline/results/report/page DESTINATION "${flexneck_data}/pipeline/results/report"
        COMPONENT runtime)

# Libraries of the source folders: target flexneck_multibody is flexneck::multibody for users of the
# package.
set(flexneck_libraries
    foundation geometry mesh partition drawing xdmf mesher exchange modal_body body_exchange fe_modal multibody
    isolation pipeline)
foreach(library ${flexneck_libraries})
  set_target_properties(flexneck_${library} PROPERTIES EXPORT_NAME ${library})
  target_compile_features(flexneck_${library} PUBLIC cxx_std_20)  # for projects that use it
  list(APPEND flexneck_targets flexneck_${library})
endforeach()
set_target_properties(flexneck_warnings PROPERTIES EXPORT_NAME warnings)
# All that is installed: pipeline/run.sh builds it, so that cmake --install and cpack work after it.
add_custom_target(product DEPENDS flexneck ${flexneck_targets})
if(TARGET flexneck_python)
  add_dependencies(product flexneck_python)
endif()
install(TARGETS ${flexneck_targets} flexneck_warnings EXPORT flexneck
        ARCHIVE COMPONENT development
        LIBRARY COMPONENT development)
install(EXPORT flexneck NAMESPACE flexneck:: FILE flexneck-targets.cmake
        DESTINATION "${flexneck_config}" COMPONENT development)
install(DIRECTORY geometry mesher fe_modal multibody pipeline DESTINATION "${flexneck_headers}"
        COMPONENT development FILES_MATCHING PATTERN "*.h"
        PATTERN "pipeline/data/models" EXCLUDE PATTERN "pipeline/data/studies" EXCLUDE
        PATTERN "pipeline/data/regulations" EXCLUDE PATTERN "pipeline/data/pictures" EXCLUDE PATTERN "pipeline/python" EXCLUDE
        PATTERN "pipeline/manual" EXCLUDE
        PATTERN "pipeline/data/verification/*.toml" EXCLUDE PATTERN "geometry/examples" EXCLUDE
        PATTERN "page" EXCLUDE)
install(FILES "${PROJECT_BINARY_DIR}/generated/pipeline/version.h"
        DESTINATION "${flexneck_headers}/pipeline" COMPONENT development)
configure_package_config_file(
  cmake/flexneck-config.cmake.in "${PROJECT_BINARY_DIR}/generated/flexneck-config.cmake"
  INSTALL_DESTINATION "${flexneck_config}" NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file("${PROJECT_BINARY_DIR}/generated/flexneck-config-version.cmake"
                                 COMPATIBILITY SameMinorVersion)
file(GLOB find_modules CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/cmake/Find*.cmake")
install(FILES "${PROJECT_BINARY_DIR}/generated/flexneck-config.cmake"
              "${PROJECT_BINARY_DIR}/generated/flexneck-config-version.cmake" ${find_modules}
        DESTINATION "${flexneck_config}" COMPONENT development)

# flexneck_pkgconfig(NAME ABOUT LIBRARIES … PACKAGES …): all are static, so nothing is private.
function(flexneck_pkgconfig name about)
  cmake_parse_arguments(ARG "" "" "LIBRARIES;PACKAGES;OTHERS" ${ARGN})
  set(libs "")
  foreach(library ${ARG_LIBRARIES})
    string(APPEND libs " -lflexneck_${library}")
  endforeach()
  foreach(other ${ARG_OTHERS})
    string(APPEND libs " -l${other}")
  endforeach()
  list(JOIN ARG_PACKAGES " " packages)
  file(RELATIVE_PATH prefix "/${CMAKE_INSTALL_LIBDIR}/pkgconfig" "/")
  set(file "${PROJECT_BINARY_DIR}/generated/${name}.pc")
  file(CONFIGURE OUTPUT "${file}" @ONLY CONTENT [[
prefix=${pcfiledir}/@prefix@
Name: @name@
Description: @about@
Version: @PROJECT_VERSION@
Requires: @packages@
Cflags: -I${prefix}/@flexneck_headers@
Libs: -L${prefix}/@CMAKE_INSTALL_LIBDIR@@libs@
]])
  install(FILES "${file}" DESTINATION "${CMAKE_INSTALL_LIBDIR}/pkgconfig" COMPONENT development)
endfunction()
flexneck_pkgconfig(
  flexneck-multibody "Bodies, joints and forces in time, with bodies that deform by their modes"
  LIBRARIES multibody modal_body foundation OTHERS udunits2
  PACKAGES eigen3 hdf5-openmpi ompi-cxx)
flexneck_pkgconfig(
  flexneck-fe_modal "Vibration modes of a mesh by finite elements"
  LIBRARIES fe_modal xdmf partition mesh OTHERS metis
  PACKAGES flexneck-multibody slepc petsc blas)
