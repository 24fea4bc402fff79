# SPDX-License-Identifier: BSD-3-Clause
# find_package(slipwave) gives the target slipwave::slipwave; includes are written as inside, "solver/simulation.hpp".
include(CMakeFindDependencyMacro)
find_dependency(Threads)
find_dependency(TBB)
find_dependency(Boost 1.74 COMPONENTS program_options)
find_dependency(PkgConfig)
pkg_check_modules(FFTW REQUIRED IMPORTED_TARGET fftw3)
pkg_check_modules(NETCDF REQUIRED IMPORTED_TARGET netcdf)
pkg_check_modules(PANGO REQUIRED IMPORTED_TARGET pangocairo>=1.50 cairo>=1.16)
include(${CMAKE_CURRENT_LIST_DIR}/slipwave-targets.cmake)
