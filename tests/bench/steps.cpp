// SPDX-License-Identifier: BSD-3-Clause
// Whole steps by order, size of the grid, material, precision, threads and tiling.
#include "bench.hpp"
#include "run.hpp"

namespace slipwave::bench {
namespace {

std::string size_name(const Case& what) {
  return "/cells:" + std::to_string(what.nx) + "x" + std::to_string(what.nz);
}

}  // namespace

void register_steps() {
  constexpr std::int64_t small = 200, far_beyond = 4000;
  // Fields and material of 200 x 200 cells stay in a second cache of 2 MiB.
  for (const int order : {1, 3, 5, 7})
    for (const std::int64_t side : {small, far_beyond})
      for (const Variety variety : {Variety::uniform, Variety::layered, Variety::random})
        for (const int threads : {1, 2}) {
          if (side == small && threads > 1) continue;
          if (side == far_beyond && variety == Variety::layered) continue;
          Case what;
          what.nx = what.nz = side;
          what.variety = variety;
          what.order = order;
          what.threads = threads;
          register_run("step/order:" + std::to_string(order) + size_name(what) +
                           "/material:" + name_of(variety) + "/threads:" + std::to_string(threads),
                       what);
        }
  for (const Variety variety : {Variety::uniform, Variety::random}) {
    Case what;
    what.nx = what.nz = far_beyond / 2;
    what.variety = variety;
    const std::string material = std::string("/material:") + name_of(variety);
    register_run("kind:float" + size_name(what) + material, what);
    what.double_precision = true;
    register_run("kind:double" + size_name(what) + material, what);
    what.double_precision = false;
    what.time_order = 4;
    register_run("kind:fourth_order_in_time" + size_name(what) + material, what);
  }
  for (const int threads : {1, 2})
    for (const int steps : {1, 2, 4})
      for (const int stripe : {128, 256, 512}) {
        if (steps > 1 && stripe != 256) continue;
        Case what;
        what.nx = what.nz = far_beyond;
        what.threads = threads;
        what.tiling.steps = steps;
        what.tiling.stripe_cells = stripe;
        register_run("tiling/steps:" + std::to_string(steps) + "/stripe:" + std::to_string(stripe) +
                         "/threads:" + std::to_string(threads),
                     what);
      }
}

}  // namespace slipwave::bench
