// SPDX-License-Identifier: BSD-3-Clause
#include <cstdlib>
#include <string>

#include "parallel/ranks_started.hpp"

// Built where no MPI was found.
namespace slipwave {

std::unique_ptr<Ranks> started_ranks() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"}) {
    const char* const count = std::getenv(name);
    if (count && std::string(count) != "1")
      throw Error("found " + excerpt(count) + " processes started together, expected one: built without MPI",
                  ErrorKind::usage);
  }
  return nullptr;
}

void end_all_ranks(int) {}

}  // namespace slipwave
