# SPDX-License-Identifier: GPL-3.0-or-later
# Sources of one folder are compiled a few at a time as one: their headers are parsed, and the
# templates of Eigen instantiated, once for all of them. With OFF a changed source is compiled by
# itself.
option(FLEXNECK_UNITY "Compile the sources of a folder together" ON)

# flexneck_compile_by_folder(TARGET [TOGETHER number] [ALONE source …]): ALONE lists the sources
# that define a name which a neighbour, too, defines for itself.
function(flexneck_compile_by_folder target)
  if(NOT FLEXNECK_UNITY)
    return()
  endif()
  cmake_parse_arguments(ARG "" "TOGETHER" "ALONE" ${ARGN})
  if(NOT ARG_TOGETHER)
    set(ARG_TOGETHER 8)
  endif()
  get_target_property(sources ${target} SOURCES)
  foreach(source ${sources})
    if(source IN_LIST ARG_ALONE)
      continue()
    endif()
    cmake_path(GET source PARENT_PATH folder)
    string(MAKE_C_IDENTIFIER "${folder}" folder)
    if(NOT DEFINED count_${folder})
      set(count_${folder} 0)
    endif()
    math(EXPR group "${count_${folder}} / ${ARG_TOGETHER}")
    math(EXPR count_${folder} "${count_${folder}} + 1")
    set_source_files_properties("${source}" PROPERTIES UNITY_GROUP "${folder}_${group}")
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
endfunction()
