// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>

namespace slipwave {

/// What the child process may take: far more than it needs for any file, with room for a busy machine.
struct ProbeLimits {
  unsigned processor_s = 5;
  std::size_t bytes = std::size_t(1) << 30;  // beyond what the process has already
};

/// Whether the netCDF and HDF5 libraries survive reading through a file: HDF5 trusts what it reads, and on
/// damaged files crashes, loops without end or takes all memory. `open` opens the file and returns its number
/// in the library, negative when it cannot. It runs in a child process, which reads every name, attribute and
/// index of the file (and the values of small ones) within `limits`; what happens there does not reach this
/// one. Other threads may run meanwhile, but none may be in the libraries. Throws Error "damaged: ..." when
/// the child dies.
void probe_netcdf(const std::function<int()>& open, const ProbeLimits& limits = ProbeLimits());

}  // namespace slipwave
