# SPDX-License-Identifier: GPL-3.0-or-later
# Headers that most sources include are parsed once per build. A set serves the targets that compile
# with the flags it was compiled with: PETSc adds flags of its own, and pipeline/ and the tests have
# another level of optimisation.
option(FLEXNECK_PRECOMPILED_HEADERS "Parse the headers that most sources include once" ON)

set(flexneck_headers_std
    <algorithm> <array> <cmath> <cstdint> <filesystem> <functional> <map> <memory> <optional>
    <span> <string> <string_view> <utility> <vector>)
set(flexneck_headers_eigen ${flexneck_headers_std} <Eigen/Core> <Eigen/Geometry>)
set(flexneck_headers_pipeline ${flexneck_headers_eigen})
set(flexneck_headers_petsc ${flexneck_headers_eigen} <slepceps.h>)
set(flexneck_headers_catch2 ${flexneck_headers_eigen} <catch2/catch.hpp>)
set(flexneck_headers_catch2_petsc ${flexneck_headers_catch2})

# flexneck_add_headers(SET LIBRARIES …): adds the target whose compiled headers others use.
function(flexneck_add_headers set)
  if(NOT FLEXNECK_PRECOMPILED_HEADERS)
    return()
  endif()
  set(source "${PROJECT_BINARY_DIR}/generated/${set}_headers.cpp")
  file(CONFIGURE OUTPUT "${source}" CONTENT "")
  add_library(flexneck_headers_${set} OBJECT "${source}")
  target_link_libraries(flexneck_headers_${set} PRIVATE flexneck::warnings ${ARGN})
  target_precompile_headers(flexneck_headers_${set} PRIVATE ${flexneck_headers_${set}})
endfunction()

# flexneck_use_headers(SET TARGET …): lets a target use the compiled headers of a set.
function(flexneck_use_headers set)
  if(NOT FLEXNECK_PRECOMPILED_HEADERS)
    return()
  endif()
  foreach(target ${ARGN})
    target_precompile_headers(${target} REUSE_FROM flexneck_headers_${set})
  endforeach()
endfunction()
