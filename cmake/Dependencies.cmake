# SPDX-License-Identifier: GPL-3.0-or-later
find_package(MPI REQUIRED COMPONENTS C CXX)

# PETSc is built on the parallel HDF5; a serial one beside it could not share handles.
set(HDF5_PREFER_PARALLEL ON)
find_package(HDF5 REQUIRED COMPONENTS C)
if(NOT HDF5_IS_PARALLEL)
  message(FATAL_ERROR "HDF5 is the serial variant; install libhdf5-openmpi-dev")
endif()

find_package(Eigen3 3.4 REQUIRED)
find_package(Gmsh REQUIRED)
find_package(METIS REQUIRED)
find_package(UDUNITS2 REQUIRED)
find_package(Boost 1.74 REQUIRED CONFIG)  # headers only: Sobol' sequences, special functions
find_package(CLI11 REQUIRED)
find_package(spdlog REQUIRED)
find_package(fmt REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(PkgConfig REQUIRED)
pkg_check_modules(cairo REQUIRED IMPORTED_TARGET cairo)
pkg_check_modules(muparser REQUIRED IMPORTED_TARGET muparser)
pkg_check_modules(libzip REQUIRED IMPORTED_TARGET libzip)
pkg_check_modules(nlopt REQUIRED IMPORTED_TARGET nlopt_cxx)
pkg_check_modules(tomlplusplus REQUIRED IMPORTED_TARGET tomlplusplus)
pkg_check_modules(slepc REQUIRED IMPORTED_TARGET slepc)
pkg_check_modules(petsc REQUIRED IMPORTED_TARGET petsc)

if(FLEXNECK_PYTHON)
  # The system's interpreter, with its NumPy and its folder for packages, whichever Python comes
  # first on the user's path.
  set(Python3_EXECUTABLE "/usr/bin/python3" CACHE FILEPATH "Interpreter of the Python package")
  set(PYBIND11_NOPYTHON ON)
  find_package(Python3 3.9 COMPONENTS Interpreter Development.Module)
  find_package(pybind11 2.10 CONFIG)
  if(NOT Python3_Development.Module_FOUND OR NOT pybind11_FOUND)
    message(STATUS "No Python package: it needs pybind11-dev and python3-dev")
    set(FLEXNECK_PYTHON OFF)
  endif()
endif()

# petsc.pc is a Debian alternative that a complex build may have taken over.
include(CheckCSourceCompiles)
set(CMAKE_REQUIRED_LIBRARIES PkgConfig::petsc MPI::MPI_C)
check_c_source_compiles(
  "#include <petscconf.h>
   #if defined(PETSC_USE_COMPLEX) || defined(PETSC_USE_64BIT_INDICES)
   #error wrong scalar or index type
   #endif
   int main(void) { return 0; }"
  FLEXNECK_PETSC_IS_REAL)
unset(CMAKE_REQUIRED_LIBRARIES)
if(NOT FLEXNECK_PETSC_IS_REAL)
  message(FATAL_ERROR "PETSc must be real with 32-bit indices; install libslepc-real-dev")
endif()
