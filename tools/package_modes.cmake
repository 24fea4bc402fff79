# SPDX-License-Identifier: BSD-3-Clause
# By cpack, once everything is in place: everybody may look into the folders, whatever the umask of who builds the packages.
file(CHMOD_RECURSE ${CPACK_TEMPORARY_DIRECTORY}
     DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
if(NOT CPACK_SLIPWAVE_KERNELS STREQUAL "all")
  message(WARNING "The inner loops of this build are compiled for processors like this machine's: "
                  "for packages that run elsewhere configure it with -DSLIPWAVE_KERNELS=all")
endif()
