# SPDX-License-Identifier: BSD-3-Clause
# `cpack -G DEB` in a build directory: slipwave (tools, man pages, completions, surveys) and libslipwave-dev.
# Read twice: by cmake, and again by cpack, which then knows the version that was built.
if(CPACK_GENERATOR)
  file(STRINGS ${CPACK_SLIPWAVE_VERSION} text REGEX version_text)
  string(REGEX REPLACE ".*\"(.*)\".*" "\\1" version "${text}")
  # In Debian's order 0.2.0~dev comes before 0.2.0.
  string(REPLACE "-" "~" version ${version})
  set(CPACK_PACKAGE_VERSION ${version})
  set(CPACK_DEBIAN_PACKAGE_VERSION ${version})
  set(CPACK_DEBIAN_LIBRARY_PACKAGE_DEPENDS
      "libboost-program-options-dev, libtbb-dev, libfftw3-dev, libnetcdf-dev, libudunits2-dev, libpango1.0-dev, pkg-config")
  return()
endif()

set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_CURRENT_LIST_DIR}/package_modes.cmake)
set(CPACK_PROJECT_CONFIG_FILE ${CMAKE_CURRENT_LIST_FILE})
set(CPACK_SLIPWAVE_VERSION ${CMAKE_BINARY_DIR}/generated/cli/version_text.hpp)
set(CPACK_SLIPWAVE_KERNELS ${SLIPWAVE_KERNELS})
set(CPACK_GENERATOR DEB)
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_PACKAGE_NAME slipwave)
set(CPACK_PACKAGE_CONTACT "The slipwave authors <slipwave@localhost>")
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL tools library)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)

set(CPACK_DEBIAN_TOOLS_PACKAGE_NAME slipwave)
set(CPACK_DEBIAN_TOOLS_PACKAGE_SECTION science)
set(CPACK_DEBIAN_TOOLS_PACKAGE_SHLIBDEPS ON)
# Pictures are written in this typeface.
set(CPACK_DEBIAN_TOOLS_PACKAGE_DEPENDS fonts-dejavu-core)
set(CPACK_DEBIAN_TOOLS_PACKAGE_RECOMMENDS make)
set(CPACK_DEBIAN_TOOLS_PACKAGE_SUGGESTS ffmpeg) # movies of sw-plot
set(CPACK_COMPONENT_TOOLS_DESCRIPTION "Seismic survey modelling for fractured media
 Tools that build models of rock, water and air, put clusters of slipping
 fractures into them, shoot them, and hand the traces on as SEG-Y.")

set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME libslipwave-dev)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libdevel)
set(CPACK_COMPONENT_LIBRARY_DESCRIPTION "Library of slipwave, seismic survey modelling
 Static library, headers, CMake files and a pkg-config file:
 find_package(slipwave), pkg-config slipwave.")
include(CPack)
