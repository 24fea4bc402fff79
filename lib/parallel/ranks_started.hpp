// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "parallel/ranks.hpp"

namespace slipwave {

/// The processes that a launcher of MPI (mpirun, srun) started together with this one; null where it runs
/// alone. To be called once, first of all that uses ranks, and kept until the last of it has ended. Throws an
/// Error where there are several and the program was built without MPI.
std::unique_ptr<Ranks> started_ranks();

/// Ends all ranks at once, with that exit status, this one too where there are others: for what went wrong on
/// one of them alone.
void end_all_ranks(int status);

}  // namespace slipwave
