# SPDX-License-Identifier: GPL-3.0-or-later
# cpack: flexneck_<version>_<architecture>.deb with the command and all shipped files,
# libflexneck-dev with libraries and headers, and python3-flexneck. dpkg-shlibdeps finds the
# libraries that the program is linked to.
set(CPACK_GENERATOR DEB)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL runtime development)
set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_PACKAGE_CONTACT "The flexneck developers <flexneck@localhost>")
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)

set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME flexneck)
set(CPACK_COMPONENT_RUNTIME_DESCRIPTION
    "Meshes the Hybrid III neck from a parametric script, finds its modes by finite
elements and moves it as a deformable body in a multibody model.")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_DEPENDS
    "gnuplot-nox | gnuplot, libjs-d3, libjs-three, fonts-dejavu-core, libopenblas0-openmp | libblas3")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_RECOMMENDS openmpi-bin)

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libflexneck-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION
    "Static libraries and headers of its rooms, for CMake and pkg-config.")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
    "pkg-config, libeigen3-dev, libhdf5-openmpi-dev, libudunits2-dev")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_RECOMMENDS
    "flexneck, libslepc-real-dev, libgmsh-dev, libmetis-dev, libcairo2-dev")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SUGGESTS
    "libboost-dev, libcli11-dev, libtomlplusplus-dev, libspdlog-dev, libfmt-dev, libmuparser-dev, libnlopt-cxx-dev, libzip-dev, nlohmann-json3-dev")
if(FLEXNECK_PYTHON)
  list(APPEND CPACK_COMPONENTS_ALL python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-flexneck)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  set(CPACK_COMPONENT_PYTHON_DESCRIPTION
      "Python package: studies, meshes, modes, models and runs as NumPy arrays.")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
  # The module is built for one version of Python; the command's package brings the files and child
  # processes.
  math(EXPR after "${Python3_VERSION_MINOR} + 1")
  string(CONCAT CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
         "flexneck (= ${PROJECT_VERSION}), python3-numpy, "
         "python3 (>= 3.${Python3_VERSION_MINOR}~), python3 (<< 3.${after}~)")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS python3-matplotlib)
endif()
include(CPack)
