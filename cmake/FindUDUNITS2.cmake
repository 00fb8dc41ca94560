# SPDX-License-Identifier: GPL-3.0-or-later
# UDUNITS2::UDUNITS2: unit conversion by Unidata's library.
find_path(UDUNITS2_INCLUDE_DIR udunits2.h PATH_SUFFIXES udunits2)
find_library(UDUNITS2_LIBRARY udunits2)
find_file(UDUNITS2_DATABASE udunits2.xml PATH_SUFFIXES xml/udunits share/xml/udunits share/udunits)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(UDUNITS2 REQUIRED_VARS UDUNITS2_LIBRARY UDUNITS2_INCLUDE_DIR
                                                           UDUNITS2_DATABASE)
if(UDUNITS2_FOUND AND NOT TARGET UDUNITS2::UDUNITS2)
  add_library(UDUNITS2::UDUNITS2 UNKNOWN IMPORTED)
  set_target_properties(
    UDUNITS2::UDUNITS2
    PROPERTIES IMPORTED_LOCATION "${UDUNITS2_LIBRARY}"
               INTERFACE_INCLUDE_DIRECTORIES "${UDUNITS2_INCLUDE_DIR}")
endif()
