#pragma once

#include <functional>

namespace slipwave {

/// Whether the netCDF and HDF5 libraries survive looking through a file: HDF5 trusts what it reads, and on
/// damaged files crashes, loops without end or takes all memory. `open` opens the file and returns its number
/// in the library, negative when it cannot. It runs in a child process, which reads every name, attribute and
/// index of the file (and the values of small ones) in limited time; what happens there does not reach this
/// one. Throws Error "damaged: ..." when the child dies.
void probe_netcdf(const std::function<int()>& open);

}  // namespace slipwave
